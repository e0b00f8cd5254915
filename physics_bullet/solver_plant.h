// The plant of contact.law bullet: Bullet's collision world and constraint solver.
#pragma once
#include <memory>

#include "core/simulation/plant.h"

namespace gaitlab {

/// Motors, hinge stops and contacts are rows of one solve at the end of the step: stable at 1 ms, of order 1 at best, and its
/// torques do not settle as the step shrinks. For comparison and clutter. It keeps what the state does not hold (contact
/// points), so that it gives no snapshots. No stage of it needs the rule h lambda <= 1.
std::unique_ptr<Plant> make_solver_plant(const PlantSettings& settings);

}  // namespace gaitlab
