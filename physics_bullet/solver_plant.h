// The plant of contact.law bullet: Bullet's collision world and constraint solver.
#pragma once
#include <memory>

#include "core/simulation/plant.h"

namespace gaitlab {

/// Motors, hinge stops and contacts are rows of one solve at the end of the step: stable at 1 ms, of order 1 at best, and its
/// torques do not converge as the step shrinks. For comparison and clutter. It keeps contact points, which the state does not
/// contain, so that snapshots are not possible. The rule h lambda <= 1 does not apply: all its parts are implicit.
std::unique_ptr<Plant> make_solver_plant(const PlantSettings& settings);

}  // namespace gaitlab
