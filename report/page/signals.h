// The signals of a run in its page, each with the quantum to which it is rounded.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "report/analysis/feet.h"
#include "report/page/packing.h"

namespace gaitlab::report {

/// A column of the recording, or computed numbers if `column` is empty.
struct Signal {
  std::string name, unit;
  double quantum = 1;
  Series column = {};
  std::vector<double> values = {};
  [[nodiscard]] double operator[](std::size_t row) const { return column.empty() ? values[row] : column[row]; }
};

/// Signals that the recording contains: time, pose of the base, centre of mass, joints, loads of docks, stability, energies,
/// boxes; then the feet as `foot.N.fx` etc. Stops that are never reached are left out. Quanta are described in docs/report.md;
/// if a quantity is small in all joints, feet or docks, its quantum is a thousandth of its largest magnitude. `loads` is
/// loads_at_rows, in which `dock.M` belongs to module M; in the result it belongs to dock M - 1. `record` and `loads` must
/// outlive the result.
std::vector<Signal> signals(const Recording& record, const Trace& loads, const std::vector<Foot>& feet,
                            const std::string& command_unit);

/// Packs all signals with every `stride`th row and the last row.
Packing packed(const std::vector<Signal>& signals, std::size_t rows, std::size_t stride);

/// Number of rows that packed() keeps.
std::size_t thinned(std::size_t rows, std::size_t stride);

/// Sentences on signals that are missing although a page could show them for this scenario.
std::vector<std::string> left_out(const Scenario& scenario, const std::vector<Signal>& signals);

}  // namespace gaitlab::report
