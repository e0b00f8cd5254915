// Export of a scenario's robot as MJCF, the format of MuJoCo.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

/// Purpose of the model: a robot that stands and walks, or exactly the dynamics without contacts and controller.
enum class MjcfModel { walking, strict };

/// MJCF text (MuJoCo 2.2 and later) of the robot in its initial state. It contains:
/// - One MuJoCo body for each body of the robot, with its full inertia tensor as principal axes and moments. Docked bodies have
/// no joint between them.
/// - Hinges with their ranges, and a free, planar (slide x, slide z, hinge y) or fixed base.
/// - The initial state as keyframe `start`, gravity and step.
/// - Shapes, contact elements, the plane and its boxes as geoms.
/// - Encoders, torque sensors, gyroscopes and accelerometers as sensors without errors.
/// A walking model (interchange/mjcf_walking.h, docs/mujoco.md) also has contacts of the contact elements with the ground,
/// stops of the hinges, and motors whose controls are set points, and is integrated implicitly. In a strict model no geom
/// collides, controls are torques, and the integrator is RK4. A comment at the top lists the parts of the scenario that are not
/// in the model. Numbers are read back as the same doubles. Throws InputError for a height field.
std::string to_mjcf(const Scenario& scenario, MjcfModel model);

}  // namespace gaitlab::interchange
