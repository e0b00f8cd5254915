// The scenario's own gait, tried before a study.
#pragma once
#include "studies/plan/plan.h"

namespace gaitlab::app {

/// Notes what the study's step costs of the first objective, compared with the limit of ever smaller steps (Richardson of the
/// step and half of it), and what steps that the integrator chooses cost, of each scenario; and its torque error.
void print_own_gait(const studies::Plan& plan, bool quiet);

}  // namespace gaitlab::app
