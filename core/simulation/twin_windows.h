// Windows in which the twin of a run with a fixed step is simulated.
#pragma once
#include "core/scenario/scenario.h"
#include "core/simulation/step_error.h"

namespace gaitlab {

/// Comparison times of a run. If the integrator has an accuracy, they cover the whole run at intervals of at most
/// StepError::kApart. If the step is fixed, they are in windows. `limited` is true for an explicit method, because a twin of
/// twice the step may be unstable.
TwinWindows twin_windows(const Scenario& scenario, bool limited);

}  // namespace gaitlab
