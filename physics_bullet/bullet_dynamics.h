// Inertia and free acceleration of the robot by Bullet's recursion, for implicit integrators.
#pragma once
#include <memory>

#include "core/simulation/plant.h"
#include "physics_articulated/other_dynamics.h"

namespace gaitlab {

std::unique_ptr<articulated::OtherDynamics> make_bullet_dynamics(const PlantSettings& settings);

}  // namespace gaitlab
