// Simulation of the runs for a golden, with their torques, side by side in threads.
#pragma once
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "golden/bands.h"

namespace gaitlab::golden {

/// Accuracy of the runs of a golden if the scenario states none. The bands of columns at the default accuracy would be wider
/// than kWidestColumn.
inline constexpr double kGoldenAccuracy = 0.001;
/// The same for joints with friction, whose torques jump as they begin and cease to stick.
inline constexpr double kStickingAccuracy = 0.0001;
/// Gives one of these accuracies to a scenario whose integrator chooses its steps, unless the scenario states an accuracy. True
/// if the accuracy has changed.
bool take_golden_accuracy(Scenario& scenario);

/// The scenario with the columns of a golden as its `trace.columns`: columns that a pattern of `selected` matches or, if it is
/// empty, those of the usual columns that the scenario's own `trace.columns` match; and those that `before` has, if the run can
/// have them. The usual columns are torque, current and angle of every joint (only the angle without motors) and the pose of
/// the base. Throws InputError for a pattern that matches no column, and for a `trace.columns` that matches no usual column.
Scenario with_golden_columns(const Scenario& scenario, const std::vector<std::string>& selected, const Trace* before = nullptr);

/// Result of one of the runs of golden_runs().
struct Attempt {
  /// Trace, numbers and, on request, the verdict. The trace has a row every 20 ms, or at the largest multiple of the trace
  /// period below that, at least one period. If a sensor has a resolution: the mean over starts (starts.h).
  GoldenRun run;
  double seconds = 0;        ///< duration of the run, for reports only, s
  std::exception_ptr error;  ///< InputError if the step is too long, RunError if the run diverged
};

/// Runs the scenarios, which have the columns of goldens (with_golden_columns), up to `jobs` at once, and returns results in
/// the order of the scenarios. `progress(share)` is called often; calls do not overlap. Results are equal bit for bit for any
/// `jobs`. If `judged`, each run has a verdict.
std::vector<Attempt> golden_runs(const std::vector<Scenario>& scenarios, int jobs,
                                 const std::function<void(double)>& progress = {}, bool judged = false);

/// Numbers that a golden of this run contains. These are all numbers except the costs of transport if the robot travels less
/// than 10 mm, because these costs are then noise. The golden of a comparison selects the numbers, so that a run on the other
/// side of that limit is still compared.
std::vector<GoldenNumber> golden_numbers(const GoldenRun& run);

/// Origin of a golden's run, for Golden::origin.
GoldenProvenance golden_origin(const Scenario& scenario);

}  // namespace gaitlab::golden
