// Runs whose torques a golden keeps, side by side in threads.
#pragma once
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "golden/bands.h"

namespace gaitlab::golden {

/// What one of several runs came to.
struct Attempt {
  /// Torque, current and angle of every joint (without a motor: the angle) and the base pose, whatever `trace.columns` says, a
  /// row every 20 ms (the largest whole multiple of the trace period up to that, at least one of it); and the figures that a
  /// golden holds. The verdict where that was asked for.
  GoldenRun run;
  double seconds = 0;        ///< that it took, for reports alone
  std::exception_ptr error;  ///< InputError: the step is too long; RunError: it diverged
};

/// One each, in the order of `scenarios`; up to `jobs` at once. `progress(share)` is called often, one call at a time. Every
/// run is an object of its own: the same bits for any `jobs`. judged: each also has its verdict.
std::vector<Attempt> golden_runs(const std::vector<Scenario>& scenarios, int jobs,
                                 const std::function<void(double)>& progress = {}, bool judged = false);

/// Those that a golden of this run holds: all, but for the costs of transport of a robot that stays (within 10 mm): they are
/// shares of noise. The golden decides, so that a run on the other side of that limit is still compared.
std::vector<Number> golden_numbers(const GoldenRun& run);

/// Which run a golden is, for Golden::origin.
GoldenProvenance golden_origin(const Scenario& scenario);

/// `scenario` with its initial joint angles moved by up to 1e-7 rad each: number `member` of the ensemble. From scenario.seed
/// alone, by splitmix64 of a counter.
Scenario perturbed(const Scenario& scenario, int member);

}  // namespace gaitlab::golden
