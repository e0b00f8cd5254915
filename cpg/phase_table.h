// Phase on a closed orbit against the angle about its centre: a table for both directions.
#pragma once
#include <cstddef>
#include <numbers>
#include <vector>

namespace gaitlab::cpg {

inline constexpr double kTurn = 2 * std::numbers::pi;  ///< one revolution, rad

/// One turn of a closed orbit in a plane. Phase: time since the orbit's start as a share of the period, 2 pi a turn. Angle:
/// that of the point of the orbit, which must rise with the phase. Both start at 0 and are 2 pi after one turn.
class PhaseTable {
 public:
  PhaseTable() = default;
  /// angles[k]: angle at phase 2 pi k / (size - 1), from 0 to 2 pi. Throws std::invalid_argument if they do not rise.
  explicit PhaseTable(std::vector<double> angles);

  /// Phase and angle of any turn, linear between entries, with the error of the table.
  [[nodiscard]] double angle(double phase) const { return look_up(angles_, phase); }
  [[nodiscard]] double phase(double angle) const { return look_up(phases_, angle); }

 private:
  static double look_up(const std::vector<double>& table, double at);

  std::vector<double> angles_, phases_;
};

}  // namespace gaitlab::cpg
