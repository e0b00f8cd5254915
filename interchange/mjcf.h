// A scenario's robot for MuJoCo.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

/// MJCF (MuJoCo 2.2 and later) of the robot in its initial state: one MuJoCo body for each of the robot's, docked ones without
/// a joint between them; whole inertia tensors (by their principal axes); hinges with their ranges; a free, planar (slide x,
/// slide z, hinge y) or fixed base; the start as keyframe `start`; gravity, step and RK4; shapes, contact elements, the plane
/// and its boxes as geoms without contact; motors as torques. Throws InputError for a heightfield. A comment at the top lists
/// the parts of the scenario that MJCF cannot hold. Numbers are read back as the same doubles.
std::string to_mjcf(const Scenario& scenario);

}  // namespace gaitlab::interchange
