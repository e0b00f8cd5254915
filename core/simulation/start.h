// Where and how a scenario's robot starts.
#pragma once
#include "core/model/kinematics.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Initial angles, speeds, pose and twist; `on_ground` puts the lowest of its contact elements (or of its outline) at height 0.
/// The quaternion has w >= 0.
RobotState start_state(const Scenario& scenario);

}  // namespace gaitlab
