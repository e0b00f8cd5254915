// Initial state of a scenario's robot.
#pragma once
#include "core/model/kinematics.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Initial angles, speeds, pose and velocities of the base. If Scenario::on_ground, the robot is lowered until the first of its
/// contact elements touches. A robot without contact elements is lowered until the lowest point of its outline is at height 0.
/// The quaternion has w >= 0.
RobotState start_state(const Scenario& scenario);

/// Initial state of the robot, lowered onto the ground even if the scenario gives a height.
RobotState lowered_start(const Scenario& scenario);

}  // namespace gaitlab
