// Trial run of a scenario's own settings before a study, which shows the error caused by the step.
#pragma once
#include "studies/plan/plan.h"

namespace gaitlab::app {

/// For each scenario, prints the error of the first objective that the study's step causes. The reference is the limit of
/// vanishing steps, by Richardson extrapolation from the step and half of it. Also prints the error with an adaptive step, and
/// the torque error.
void print_own_gait(const studies::Plan& plan, bool quiet);

}  // namespace gaitlab::app
