// Bending of a dock in dense rows of the trace, and in the loads that the verdict uses.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/recording/recording_file.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {

/// Largest bending moments of the dock of module m1, without torsion, N m.
struct DenseBending {
  double dense = 0;     ///< of all rows of the trace
  double at_ticks = 0;  ///< of the rows at control ticks
  double watched = 0;   ///< of the table of loads

  /// `rows_per_tick`: number of rows of the trace per control period.
  DenseBending(const Recording& record, std::size_t rows_per_tick) {
    const Table table(record.trace);
    for (std::size_t row = 0; row < record.trace.rows(); ++row) {
      const double bending = std::hypot(table.at(row, "reaction.m1/dock.mx"), table.at(row, "reaction.m1/dock.my"),
                                        table.at(row, "reaction.m1/dock.mz"));
      dense = std::max(dense, bending);
      if (row % rows_per_tick == 0) at_ticks = std::max(at_ticks, bending);
    }
    const Table loads(record.loads);
    for (std::size_t row = 0; row < record.loads.rows(); ++row) watched = std::max(watched, loads.at(row, "dock.1.bending"));
  }
};

}  // namespace gaitlab::test
