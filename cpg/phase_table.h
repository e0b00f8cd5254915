// Table of the phase on a closed orbit against the angle about its centre, for both directions.
#pragma once
#include <cstddef>
#include <numbers>
#include <vector>

namespace gaitlab::cpg {

inline constexpr double kTurn = 2 * std::numbers::pi;  ///< one revolution, rad

/// One turn of a closed orbit in a plane. The phase is 2 pi times the time since the orbit's start, divided by the period. The
/// angle of the point about the centre must increase with the phase. Both are 0 at the start and 2 pi after one turn.
class PhaseTable {
 public:
  PhaseTable() = default;
  /// Makes a table from angles[k], the angle at phase 2 pi k / (size - 1), from 0 to 2 pi. Throws std::invalid_argument if the
  /// angles do not increase.
  explicit PhaseTable(std::vector<double> angles);

  /// Angle at a phase, and phase at an angle, on any turn. Values between the entries of the table are interpolated linearly.
  [[nodiscard]] double angle(double phase) const { return look_up(angles_, phase); }
  [[nodiscard]] double phase(double angle) const { return look_up(phases_, angle); }

 private:
  static double look_up(const std::vector<double>& table, double at);

  std::vector<double> angles_, phases_;
};

}  // namespace gaitlab::cpg
