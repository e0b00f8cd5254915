// Checks of a verdict on the loads of docks and feet (Recording::loads).
#pragma once
#include <optional>
#include <vector>

#include "report/verdict/verdict.h"

namespace gaitlab::report {

enum class DockQuantity { tension, shear, bending, torsion };

/// Load limits of the docks, indexed by module, in N or N m: the smaller limit of the two connectors. NaN if it is not stated.
/// An empty result of this type also means that no limit is stated.
std::vector<double> dock_limits(const Robot& robot, DockQuantity quantity);

/// Compares the largest load of each dock in the whole run with `limits` and reports the dock with the least margin. If no
/// limit is stated, reports the largest load, not judged. Tension counts only if it pulls the faces apart; torsion counts in
/// both directions.
void judge_docks(const Scenario& scenario, const Recording& record, DockQuantity quantity, const std::vector<double>& limits,
                 Check& made);

/// Divides the distance that loaded feet slide, weighted by load, by the length of the robot's path, in the judged window.
/// Warns above Limits::slip.
void judge_slip(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made);

/// Divides the way that loaded feet creep below contact.slip_speed, a vector weighted by load, by the displacement of the
/// centre of mass, in the judged window. On a real ground such feet would hold. Warns above 2 %.
void judge_creep(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made);

/// Least distance of the centre of mass from the edge of the support polygon, positive inside. It is a note without a limit and
/// always passes, because a dynamic gait may leave the support polygon.
void judge_stability(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made);

/// Largest torque that a gear passes on in a run.
struct GearPeak {
  double torque = 0, time = 0;        ///< N m, s
  std::optional<double> beyond = {};  ///< s, time when the torque was first above the limit
};

/// Peak of a joint's gear, from the column `gear.J.torque` of the loads; nothing without that column. A `limit` of 0 (N m) is
/// not exceeded.
std::optional<GearPeak> gear_load(const Recording& record, std::size_t joint, double limit);

}  // namespace gaitlab::report
