// Loads of docks, feet and gears (Recording::loads), as checks read them.
#pragma once
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Rows of Recording::loads within the judged window, and the row before the window.
struct LoadWindow {
  const Trace& loads;
  std::size_t start = 0;

  /// Window that covers the whole run.
  explicit LoadWindow(const Recording& record) : loads(record.loads) {}
  /// Judged window of a run. Row indices in Recording::loads and Recording::ticks are equal.
  LoadWindow(const Recording& record, const Summary& summary)
      : loads(record.loads), start(std::min(summary.judged.first_row, std::max<std::size_t>(record.loads.rows(), 1) - 1)) {}
  [[nodiscard]] Series series(const std::string& name) const {
    const std::size_t at = loads.find(name);
    return at < loads.columns.size() && loads.rows() > 0 ? Series(loads, at) : Series();
  }
  /// Increase within the window of a sum that starts at t = 0.
  [[nodiscard]] double grown(const Series& sum) const { return sum.empty() ? kUnknown : sum.back() - sum[start]; }
  [[nodiscard]] double time(std::size_t row) const { return loads.at(row, 0); }
};

/// Reason why the loads of feet and docks are not known. Empty if they are.
std::string unknown_loads(const Scenario& scenario, const Recording& record);
/// The same for feet, which are judged only on a ground.
std::string unknown_of_feet(const CheckedRun& run);
/// True if the robot travels far enough in the judged window; `way` is its distance, m. If not, the check states this and is
/// not judged.
bool walks(double way, Check& made);

enum class DockQuantity { tension, shear, bending, torsion };
/// The quantity of a check, such as `dock_shear`; nothing for other checks.
std::optional<DockQuantity> dock_quantity(std::string_view check);

/// Load limits of the docks, indexed by module, in N or N m: the smaller limit of the two connectors. NaN if it is not stated.
/// An empty result of this type also means that no limit is stated.
std::vector<double> dock_limits(const Robot& robot, DockQuantity quantity);

/// Compares the largest load of each dock in the whole run with `limits` and reports the dock with the least margin. If no
/// limit is stated, reports the largest load, not judged. Tension counts only if it pulls the faces apart; torsion counts in
/// both directions.
void judge_docks(const Scenario& scenario, const Recording& record, DockQuantity quantity, const std::vector<double>& limits,
                 Check& made);

/// Largest torque that a gear passes on in a run.
struct GearPeak {
  double torque = 0, time = 0;        ///< N m, s
  std::optional<double> beyond = {};  ///< s, time when the torque was first above the limit
};

/// Peak of a joint's gear, from the column `gear.J.torque` of the loads; nothing without that column. A `limit` of 0 (N m) is
/// not exceeded.
std::optional<GearPeak> gear_load(const Recording& record, std::size_t joint, double limit);

}  // namespace gaitlab::report
