// Trial of the scenario's gait before a study.
#pragma once
#include "studies/plan/plan.h"

namespace gaitlab::app {

/// Prints for each scenario the error of the first objective caused by the study's step, against the limit of ever smaller
/// steps (Richardson extrapolation of the step and half of it), the error with steps that the integrator chooses, and the
/// torque error.
void print_own_gait(const studies::Plan& plan, bool quiet);

}  // namespace gaitlab::app
