// Plant of contact.law bullet, with the collision world and constraint solver of Bullet.
#pragma once
#include <memory>

#include "core/simulation/plant.h"

namespace gaitlab {

/// Motors, hinge stops and contacts are rows of one solve at the end of the step. The method is stable at 1 ms, of order 1 at
/// best, and its torques do not converge as the step shrinks. It serves for comparison, and for robots among loose boxes. The
/// plant keeps contact points that the state does not contain, so that snapshots are not possible. The rule h lambda <= 1 does
/// not apply, because all parts of the method are implicit.
std::unique_ptr<Plant> make_solver_plant(const PlantSettings& settings);

}  // namespace gaitlab
