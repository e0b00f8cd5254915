// A recording with one row, for a robot that has not run.
#pragma once
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Recording of pose, angles and centre of mass at the start. Its outcome is `not run`.
Recording start_row(const Scenario& scenario);

}  // namespace gaitlab::report
