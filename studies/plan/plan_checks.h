// Checks of a plan by trying its runs, before the first of them.
#pragma once
#include <vector>

#include "core/errors.h"
#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Tries the first and the last run: what both refuse no run can have, a misspelt key above all. InputError.
void check_corners(const Plan& plan);

/// Ends of parameters that a scenario refuses, its other keys as they are.
std::vector<Problem> refused_ends(const Plan& plan);

/// Parameters whose slowest gait does not have the three periods in the run that a verdict needs.
std::vector<Problem> short_runs(const Plan& plan);

}  // namespace gaitlab::studies
