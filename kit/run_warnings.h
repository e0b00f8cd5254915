// Warnings about a scenario and a run, with their places.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/verdict.h"
#include "report/verdict/warnings.h"

namespace gaitlab::kit {

/// Warnings about a scenario before it runs: a robot that starts below the ground, and those of report::setup_warnings.
std::vector<report::Warning> start_warnings(const Scenario& scenario);

/// Verdict::unstable alone if it is not empty; else each check that does not pass and has a remedy, at the place of the setting
/// to change, and the numbers of the run that are not finite.
std::vector<report::Warning> run_warnings(const Scenario& scenario, const Recording& recording, const report::Verdict& verdict);

/// True if further rollouts of the run should show the spread of its results, because its motion is not predictable.
bool needs_spread(const Scenario& scenario, const Recording& recording);

}  // namespace gaitlab::kit
