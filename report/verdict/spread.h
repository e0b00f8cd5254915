// Spread of the numbers of an unpredictable motion, over equally valid rollouts.
#pragma once
#include <atomic>
#include <optional>
#include <string>

#include "core/scenario/scenario.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Table Recording::spread of a run that is not predictable, or ill-conditioned (report/verdict/trust.h): its numbers, and
/// those of the scenario under gravity times 1 + d and 1 - d, d = 1e-9 or 1e-6, and with half the accuracy, which are simulated
/// here. No rows: the run is predictable, or ended early, or `stop` was set. Throws InputError and PluginError.
Trace spread(const Scenario& scenario, const Recording& record, const Summary& summary, const Verdict& verdict,
             std::atomic<bool>& stop);

/// Name of the column of the least margin.
inline constexpr const char* kLeastMargin = "margin";
/// Name of a check's column.
std::string margin_column(const std::string& check);

struct Between {
  double low, high;
};
/// `of 4 rollouts that differ by next to nothing the torque peaks at 0.91 to 1.3 N m, ...`; empty without rows.
std::string spread_text(const Trace& spread);
/// Least and largest value of a column; nothing if the column is missing or a value is not known.
std::optional<Between> between(const Trace& spread, const std::string& column);

}  // namespace gaitlab::report
