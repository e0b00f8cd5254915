// Export of a scenario's robot as MJCF, the format of MuJoCo.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

/// MJCF text (MuJoCo 2.2 and later) of the robot in its initial state. It contains:
/// - One MuJoCo body for each body of the robot, with its full inertia tensor as principal axes and moments. Docked bodies have
/// no joint between them.
/// - Hinges with their ranges, and a free, planar (slide x, slide z, hinge y) or fixed base.
/// - The initial state as keyframe `start`, gravity, step and integrator RK4.
/// - Shapes, contact elements, the plane and its boxes as geoms that do not collide.
/// - Motors that apply the control as a torque.
/// - Encoders, torque sensors, gyroscopes and accelerometers as sensors without errors.
/// A comment at the top lists the parts of the scenario that MJCF cannot represent. Numbers are read back as the same doubles.
/// Throws InputError for a height field.
std::string to_mjcf(const Scenario& scenario);

}  // namespace gaitlab::interchange
