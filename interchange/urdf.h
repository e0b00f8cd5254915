// A scenario's robot as URDF.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

/// One URDF link per body of the robot, with its name; revolute joints with range, torque (of the motor at rest) and speed
/// (without load) as limits, fixed joints `m3/dock` between docked bodies. The frame of a link is that of its joint, which for
/// a body behind a reversed hinge differs from the body's. Base: a link without parent (floating), or a link `world` with a
/// fixed or planar joint. A comment at the top lists the parts of the scenario that URDF cannot hold. Numbers are read back as
/// the same doubles, angles (rpy) up to rounding.
std::string to_urdf(const Scenario& scenario);

}  // namespace gaitlab::interchange
