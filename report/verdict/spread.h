// Spread of the numbers of an unpredictable motion over rollouts that are equally valid.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "core/scenario/scenario.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Table Recording::spread for a run that is chaotic or ill-conditioned (report/verdict/trust.h), with one row per rollout. The
/// first row is that of the run itself. The others are simulated here: with gravity times 1 + d and 1 - d (d = 1e-9 if chaotic,
/// else 1e-6), and with half the accuracy. The table has no rows if the run is predictable or ended early, or if `stop` was
/// set. `ended` is called after each of the kSpread rollouts. Throws InputError and PluginError.
Trace spread(const Scenario& scenario, const Recording& record, const Summary& summary, const Verdict& verdict,
             std::atomic<bool>& stop, const std::function<void()>& ended = {});
inline constexpr std::size_t kSpread = 3;  ///< number of rollouts that spread() simulates

struct Between {
  double low, high;
};
/// Text `in 4 rollouts that differ by next to nothing, the torque peaks at 0.91 to 1.3 N m, ...`; empty if the table has no
/// rows.
std::string spread_text(const Trace& spread);
/// Least and largest value of a column. Nothing if the column is missing or one of its values is not known.
std::optional<Between> between(const Trace& spread, const std::string& column);

}  // namespace gaitlab::report
