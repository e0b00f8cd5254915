// Optional parts of a recording, and the memory that its rows need.
#pragma once

namespace gaitlab {

/// Size of the table of rows that a run keeps until its end.
struct RowsNeeded {
  double rows = 0, columns = 0;
  [[nodiscard]] double bytes() const { return 8 * rows * columns; }
};

/// Extent of Recording::loads. `recorded` means all columns, which require the accelerations at every control tick. `judged`
/// means path lengths and slip, and the loads of docks if any dock has rated loads.
enum class Loads { left_out, judged, recorded };

/// Optional parts of a recording. Ticks, poses and the statistics of all steps are always recorded.
struct Records {
  constexpr Records(Loads of = Loads::left_out, bool with_rows = true) : loads(of), rows(with_rows) {}
  Loads loads;
  bool rows;  ///< true if Recording::trace and rest have columns
};

}  // namespace gaitlab
