// Initial state of a scenario's robot.
#pragma once
#include "core/model/kinematics.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Initial angles, speeds, pose and twist. `on_ground` lowers the robot until the first of its contact elements touches
/// (without any, its outline's lowest point to height 0). The quaternion has w >= 0.
RobotState start_state(const Scenario& scenario);

/// The same, lowered onto the ground even if the scenario gives a height.
RobotState lowered_start(const Scenario& scenario);

}  // namespace gaitlab
