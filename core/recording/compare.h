// Differences between two traces.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/recording/column_names.h"
#include "core/recording/trace.h"

namespace gaitlab {

struct CompareOptions {
  std::vector<std::string> columns = {"*"};  ///< glob patterns; a column counts if one matches its name or its label
  double divergence = 1e-6;                  ///< share of a column's scale: the traces diverge at a larger difference
  PartNames names = {};                      ///< for labels
};

/// One column of both traces, over the shared rows.
struct ColumnDifference {
  std::string name;
  std::string label;   ///< readable name (column_names.h): `m7/passive torque`
  std::string unit;    ///< A's, or B's if A (a CSV file) has none
  bool equal = false;  ///< to the bit
  double rms = 0;      ///< of B - A, in the column's unit
  double maximum = 0;  ///< of |B - A|, in the column's unit
  double range = 0;    ///< A's largest value minus its smallest
  double scale =
      0;  ///< reference of `relative`: `range`, or if that is below 1e-9 the largest magnitude in A and B, at least 1e-9
  double relative_rms = 0;      ///< rms / scale; 0 if both are 0
  double relative_maximum = 0;  ///< maximum / scale; 0 if both are 0
  std::optional<double>
      first_divergence;        ///< s; first time with a difference above `divergence` * scale, or with a NaN in one trace only
  double time_shift = 0;       ///< s; positive: B is late (see best_shift); 0 if no shift explains the difference
  double rms_after_shift = 0;  ///< rms if time_shift is 0
};

struct TraceDifference {
  /// Reasons why the traces are incomparable or the numbers partial, one sentence each: other columns, units, rows, times,
  /// values that are not finite. Empty: they have the same form.
  std::vector<std::string> findings;
  std::vector<std::string> only_a, only_b;  ///< names of matching columns that the other trace lacks
  std::size_t rows = 0;                     ///< number of rows with the same time in both, to which the numbers refer
  std::vector<ColumnDifference> columns;    ///< in A's order; without `t`
};

/// Compares B with A, the reference. Form first (see findings), then numbers: rows are paired by time (equal to a millionth of
/// A's mean spacing), so that traces of different length or period can be compared in part; values that are not finite in
/// either trace are left out of the numbers. Without a common increasing time column there are no numbers. Deterministic; about
/// a millisecond per column and 4000 rows.
TraceDifference compare(const Trace& a, const Trace& b, const CompareOptions& options = {});

}  // namespace gaitlab
