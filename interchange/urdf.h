// A scenario's robot as URDF.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

/// One URDF link for each of the robot's bodies, named like it; revolute joints with range, torque (of the motor at rest) and
/// speed (at which it gives none) as limits, fixed joints `m3/dock` where bodies are docked. A link's frame is that of its
/// joint, which for a body behind a reversed hinge is not the body's own. Base: a link without parent (floating), or a link
/// `world` with a fixed or planar joint. What URDF cannot hold is said in a comment at its top. Numbers read back to the same
/// doubles; angles (rpy) to rounding.
std::string to_urdf(const Scenario& scenario);

}  // namespace gaitlab::interchange
