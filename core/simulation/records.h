// The wanted parts of a recording, and the memory that they take.
#pragma once

namespace gaitlab {

/// The rows of numbers that a run keeps until its end.
struct RowsNeeded {
  double rows = 0, columns = 0;
  [[nodiscard]] double bytes() const { return 8 * rows * columns; }
};

/// Extent of Recording::loads. recorded: all columns, which need the accelerations at every control tick. judged: ways and
/// slip, and docks if any has rated loads.
enum class Loads { left_out, judged, recorded };

/// Parts of a recording beside ticks, poses and the statistics of all steps.
struct Records {
  constexpr Records(Loads of = Loads::left_out, bool with_rows = true) : loads(of), rows(with_rows) {}
  Loads loads;
  bool rows;  ///< of Recording::trace and rest; false: these have no columns
};

}  // namespace gaitlab
