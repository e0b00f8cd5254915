// Checks of a robot before its first step.
#pragma once
#include "core/model/kinematics.h"
#include "core/plugin/fields.h"
#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Makes the engine's plant. Throws InputError at physics.engine if the robot has too many joints for the engine.
std::unique_ptr<Plant> make_plant(const Scenario& scenario, const PlantSettings& settings);

/// Checks that every joint moves some inertia at the start. Otherwise its acceleration is undefined: for example, a massless
/// body between two hinges with the same axis could turn freely. `kinematics` is in the initial pose. `rotors` contains the
/// reflected inertia of joint j, kg m^2, at index j * lanes + lane, or is empty. Throws InputError at `place`, with the name of
/// the joint.
void check_inertia(const Scenario& scenario, const Kinematics& kinematics, In rotors, std::size_t lanes, std::size_t lane,
                   const SourceLocation& place);

}  // namespace gaitlab
