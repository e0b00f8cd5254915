// Angle by which legs yield under the robot's weight.
#pragma once
#include <optional>
#include <span>

#include "core/plugin/robot_info.h"
#include "report/verdict/plausible/plausible_number.h"
#include "report/verdict/position_loop.h"

namespace gaitlab::report {

struct LegSag {
  PositionLoop loop;  ///< of the joint that yields most
  double angle = 0;   ///< rad
};

/// Largest angle by which a joint of a leg yields in the pose q (rad) with the base upright, if each of the n feet carries an
/// equal share of the weight m g:
///
///     angle = |up . (axis x (foot - origin))| (m g / n) / k
///
/// k: stiffness of its position loop, N m/rad. A gait lifts feet, so that its legs yield by more: a trot by twice as much.
/// Nothing without legs or position loops. Throws PluginError.
std::optional<LegSag> leg_sag(const Scenario& scenario, const RobotInfo& robot, std::span<const double> q);

/// Warning of legs that yield by more than 0.03 rad (chosen) at the start, with the gain and the control period that hold them.
/// Throws PluginError.
std::optional<Warning> sag_warning(const Scenario& scenario);

}  // namespace gaitlab::report
