// Signals of a run in its page, with the quantum to which each is rounded.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "report/analysis/feet.h"
#include "report/page/packing.h"

namespace gaitlab::report {

/// A column of the recording, or computed numbers.
struct Signal {
  std::string name, unit;
  double quantum = 1;
  Series column = {};
  std::vector<double> values = {};
  [[nodiscard]] double operator[](std::size_t row) const { return column.empty() ? values[row] : column[row]; }
};

/// Time, pose of the base, centre of mass, joints, loads of docks, stability, energies and boxes, as far as the recording has
/// them, then the feet, `foot.N.fx`. Stops that are never reached are left out. Quanta: see docs/report.md; if a quantity is
/// small in all joints, feet or docks, a thousandth of its largest magnitude. `loads`: loads_at_rows, where `dock.M` is of
/// module M; here it is of the dock M - 1. `record` and `loads` outlive the result.
std::vector<Signal> signals(const Recording& record, const Trace& loads, const std::vector<Foot>& feet,
                            const std::string& command_unit);

/// All signals, of every `stride`th row and the last one.
Packing packed(const std::vector<Signal>& signals, std::size_t rows, std::size_t stride);

/// Number of these rows.
std::size_t thinned(std::size_t rows, std::size_t stride);

/// Sentences on signals that are missing, which a page could show for the scenario.
std::vector<std::string> left_out(const Scenario& scenario, const std::vector<Signal>& signals);

}  // namespace gaitlab::report
