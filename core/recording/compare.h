// What differs between two traces.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/recording/column_names.h"
#include "core/recording/trace.h"

namespace gaitlab {

struct CompareOptions {
  std::vector<std::string> columns = {"*"};  ///< glob patterns; a column counts if one matches its name or its label
  double divergence = 1e-6;                  ///< of a column's scale: a difference above it is where the traces part
  PartNames names = {};                      ///< for labels
};

/// One column that both traces have, over the rows they share.
struct ColumnDifference {
  std::string name;
  std::string label;   ///< for people (column_names.h): `m7/passive torque`
  std::string unit;    ///< A's, or B's where A (a CSV file) has none
  bool equal = false;  ///< to the bit
  double rms = 0;      ///< of B - A, in the column's unit
  double maximum = 0;  ///< of |B - A|, in the column's unit
  double range = 0;    ///< A's largest less its smallest value
  double scale =
      0;  ///< what `relative` means: `range`; where that is below 1e-9 the largest magnitude in A and B, at least 1e-9
  double relative_rms = 0;                 ///< rms / scale; 0 where both are 0
  double relative_maximum = 0;             ///< maximum / scale; 0 where both are 0
  std::optional<double> first_divergence;  ///< s; first time with a difference above `divergence` * scale, or a lone NaN
  double time_shift = 0;                   ///< s; positive: B is late (see best_shift); 0 where no shift explains it
  double rms_after_shift = 0;              ///< rms where time_shift is 0
};

struct TraceDifference {
  /// What makes the traces incomparable or the numbers partial, a sentence each: other columns, units, rows, times, values that
  /// are not finite. Empty: they have the same form.
  std::vector<std::string> findings;
  std::vector<std::string> only_a, only_b;  ///< names of columns that match and that the other trace has not
  std::size_t rows = 0;                     ///< with the same time in both: those the numbers are about
  std::vector<ColumnDifference> columns;    ///< in A's order; without `t`
};

/// Compares B with A, the reference. Form first (see findings), then numbers: rows are paired by time (equal to a millionth of
/// A's mean spacing), so that traces of other length or period are compared where they can be; values that are not finite in
/// either are left out of the numbers. Without a common increasing time column there are no numbers. Deterministic; about a
/// millisecond a column and 4000 rows.
TraceDifference compare(const Trace& a, const Trace& b, const CompareOptions& options = {});

}  // namespace gaitlab
