// Checks of a study before its first run, by trial of the settings of some runs.
#pragma once
#include <vector>

#include "core/errors.h"
#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Tries each listed value of each parameter with the scenario's other keys. If it is refused, tries it with every combination
/// of the other listed values, at the low and then the high ends of the ranges. Adds the values that are always refused,
/// because no run could have them. A value counts as possible if there are more than 1000 combinations. If no value is added,
/// tries the settings of the first and the last run. If both are refused, adds the problems of the first, such as a misspelt
/// key. Adds nothing at places that already have a problem.
void check_settings(const Plan& plan, Problems& problems);

/// Ends of parameter ranges that a scenario refuses while its other keys remain as they are.
std::vector<Problem> refused_ends(const Plan& plan);

/// Parameters whose slowest gait has fewer periods in the run than the three that a verdict needs.
std::vector<Problem> short_runs(const Plan& plan);

}  // namespace gaitlab::studies
