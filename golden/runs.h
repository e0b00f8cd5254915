// Runs with the torques for a golden, side by side in threads.
#pragma once
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "golden/bands.h"

namespace gaitlab::golden {

/// Result of one of several runs.
struct Attempt {
  /// Torque, current and angle of every joint (without a motor: the angle) and the base pose, for any `trace.columns`, a row
  /// every 20 ms (the largest whole multiple of the trace period up to that, at least one of it); and the numbers of a golden.
  /// The verdict on request.
  GoldenRun run;
  double seconds = 0;        ///< duration of the run, for reports alone
  std::exception_ptr error;  ///< InputError: the step is too long; RunError: it diverged
};

/// Runs the scenarios; results in their order, up to `jobs` at once. `progress(share)` is called often, one call at a time.
/// Every run is a separate object: the same bits for any `jobs`. judged: each run also has its verdict.
std::vector<Attempt> golden_runs(const std::vector<Scenario>& scenarios, int jobs,
                                 const std::function<void(double)>& progress = {}, bool judged = false);

/// Numbers that a golden of this run contains: all, except the costs of transport of a robot that does not travel (less than 10
/// mm): they are shares of noise. The golden decides, so that a run on the other side of that limit is still compared.
std::vector<Number> golden_numbers(const GoldenRun& run);

/// Origin of a golden's run, for Golden::origin.
GoldenProvenance golden_origin(const Scenario& scenario);

/// `scenario` with its initial joint angles moved by up to 1e-7 rad each: number `member` of the ensemble. Depends on
/// scenario.seed alone, by splitmix64 of a counter.
Scenario perturbed(const Scenario& scenario, int member);

}  // namespace gaitlab::golden
