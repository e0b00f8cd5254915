// Joint angles of a robot that stands on its legs.
#pragma once
#include <vector>

#include "core/plugin/robot_info.h"
#include "cpg/leg_kinematics.h"

namespace gaitlab::cpg {

/// Angles of all joints, rad. They are the angles of the start if the scenario states them. Otherwise all feet are on one
/// plane, below the hips, at `height` (share of the length of the shortest leg; 0: the largest of 0.75, 0.7 ... 0.5 that keeps
/// all joints of legs 0.15 rad from their stops, else 0.75), with the lateral distance that they have at zero angles. Legs
/// whose first hinge is within 45 degrees of the vertical stand 0.6 of their length beside it, at two thirds of that height.
///
/// The angles follow from damped least squares from 41 starts, the same for every leg except for the signs of mirrored axes.
/// The result is the one with the least cost,
///     sum over legs of 10 |error| / length + mean |q| + 0.3 (if a joint is within 0.15 rad of a stop) + unlike / length,
/// unlike: standard deviation of the distances from hip to knee, forwards or outwards, whichever is less.
///
/// The feet of `legs` become the elements that are lowest in the stance, and the stance is found again, in at most three
/// rounds.
std::vector<double> stance_of(const RobotInfo& robot, std::vector<LegKinematics>& legs, double height);

}  // namespace gaitlab::cpg
