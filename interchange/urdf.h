// Export of a scenario's robot as URDF.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

inline constexpr double kUnlimited = 1e6;      ///< N m and rad/s; means no limit, because the format requires a number
inline constexpr double kPointRadius = 0.001;  ///< m, radius of a contact element that is a point

/// URDF text of the robot, with one link of the same name for each body. A hinge is a revolute joint whose limits are its
/// range, the motor's torque at rest and its no-load speed. Docked bodies are connected by fixed joints such as `m3/dock`. The
/// frame of a link is that of its joint, which differs from the frame of a body behind a reversed hinge. A floating base is a
/// link without parent; otherwise a link `world` has a fixed or planar joint. A comment at the top lists the parts of the
/// scenario that URDF cannot represent. Numbers are read back as the same doubles, angles (rpy) up to rounding.
std::string to_urdf(const Scenario& scenario);

}  // namespace gaitlab::interchange
