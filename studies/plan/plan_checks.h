// Checks of a study before its first run, by trial of the settings of some runs.
#pragma once
#include <vector>

#include "core/errors.h"
#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Tries each listed value of each parameter with the scenario's other keys and, if it is refused, with every combination of
/// the other listed values, beside the low and then the high ends of the ranges. Adds the values that are refused in all of
/// these, which no run could have; with more than 1000 combinations a value counts as possible. If there is none, tries the
/// settings of the first and the last run, and adds the problems common to both, such as a misspelt key, except at places that
/// have a problem already.
void check_settings(const Plan& plan, Problems& problems);

/// Ends of parameter ranges that a scenario refuses while its other keys remain as they are.
std::vector<Problem> refused_ends(const Plan& plan);

/// Parameters whose slowest gait has fewer periods in the run than the three that a verdict needs.
std::vector<Problem> short_runs(const Plan& plan);

}  // namespace gaitlab::studies
