// Runs of a scenario with slightly different starts, and their means, for goldens of scenarios that amplify rounding errors.
#pragma once
#include <span>
#include <vector>

#include "core/scenario/scenario.h"
#include "golden/bands.h"

namespace gaitlab::golden {

/// Scenario for member number `member` of an ensemble: `scenario` with each initial joint angle changed by up to 1e-7 rad. The
/// changes depend only on scenario.seed, `member` and the joint, by splitmix64 of a counter.
Scenario perturbed(const Scenario& scenario, int member);

/// Scenarios whose runs a golden of `scenario` needs: the scenario; if a sensor has a resolution, the scenario and kStarts - 1
/// scenarios with each initial joint angle changed by up to 1e-3 rad. A quantiser in a control loop can amplify the last bit of
/// a number to a quarter of the range of a torque, so that another build has another motion, but the same mean numbers within
/// their spread.
std::vector<Scenario> starts(const Scenario& scenario);

/// The only run, or a run with the mean and the standard deviation of each number over the runs. Joints and verdict are those
/// of the first run, and the trace has only its column `t`. All runs must have the same summary numbers.
GoldenRun mean_of(std::span<const GoldenRun> runs);

}  // namespace gaitlab::golden
