// Numbers of one of several rollouts of a scenario, as columns of a table.
#pragma once
#include "core/recording/recording.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// A rollout: its recording, and the results computed from it.
struct Rolled {
  const Recording& record;
  const Summary& summary;
  const Verdict& verdict;
};

/// Name of the column with the least margin of all checks that can fail.
inline constexpr const char* kLeastMargin = "margin";
/// Name of the column with the margin of this check.
std::string margin_column(const std::string& check);

/// Columns torque_peak, torque_rms, distance, margin, and the margin of each check.
std::vector<Column> rolled_columns();
/// The values of rolled_columns().
std::vector<double> rolled_row(const Rolled& run);

}  // namespace gaitlab::report
