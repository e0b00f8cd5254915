// Notes on a study before its first run, by trial of the settings of some runs.
#pragma once
#include <vector>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Ends of parameter ranges that a scenario refuses while its other keys remain as they are.
std::vector<Problem> refused_ends(const Plan& plan);

/// Parameters whose slowest gait has fewer periods in the run than the three that a verdict needs.
std::vector<Problem> short_runs(const Plan& plan);

}  // namespace gaitlab::studies
