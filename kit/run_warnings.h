// Warnings about a scenario and a run, with their places.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/verdict.h"
#include "report/verdict/warnings.h"

namespace gaitlab::kit {

/// Warnings about a scenario before it runs: a robot that starts below the ground, and the warnings of report::setup_warnings.
std::vector<report::Warning> start_warnings(const Scenario& scenario);

/// Warnings about a run. If Verdict::unstable is not empty, it is the only one. Otherwise they are the checks that do not pass
/// and have a remedy, each at the place of the setting to change, and the numbers of the run that are not finite.
std::vector<report::Warning> run_warnings(const Scenario& scenario, const Recording& recording, const report::Verdict& verdict);

/// True if further rollouts of the run should show the spread of its results, because its motion is not predictable.
bool needs_spread(const Scenario& scenario, const Recording& recording);

}  // namespace gaitlab::kit
