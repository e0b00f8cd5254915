// Checks of a robot before its first step.
#pragma once
#include "core/model/kinematics.h"
#include "core/plugin/fields.h"
#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Makes the engine's plant. Throws InputError at physics.engine if the robot has too many joints for the engine.
std::unique_ptr<Plant> make_plant(const Scenario& scenario, const PlantSettings& settings);

/// Checks that every joint has some inertia to move at the start; without, its acceleration is undefined: a body without mass
/// between two hinges whose axes are in line turns freely. `kinematics`: at the start; `rotors`: reflected inertia of joint j,
/// kg m^2, at j * lanes + lane, or empty. Throws InputError naming the joint, at `place`.
void check_inertia(const Scenario& scenario, const Kinematics& kinematics, In rotors, std::size_t lanes, std::size_t lane,
                   const SourceLocation& place);

}  // namespace gaitlab
