// Extent of a robot in a pose.
#pragma once
#include "core/model/kinematics.h"

namespace gaitlab {

/// Diagonal of the box around all links and contact elements, m.
double extent(const Robot& robot, const RobotState& state);

}  // namespace gaitlab
