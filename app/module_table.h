// A module type in numbers, as `gaitlab list module` and `explain module` print it.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::app {

/// What a user chooses a module by, from a robot of one module: `65 x 65 x 130 mm  0.400 kg  2 hinges  1.97 N m`. Torque: the
/// largest that a hinge's motor has at rest; `-` where no hinge has a motor that states it.
std::string module_row(const Scenario& one);

/// Size (the box around all shapes at zero angles, the smallest edge first), mass, hinges with the torque at rest and the speed
/// without load that their motors have, faces with their connectors, what the connectors bear, and the source of every part.
/// Lines of at most 100 characters, in the units of the user; degrees for ranges. `one`: a robot of one module.
std::string module_table(const Scenario& one);

}  // namespace gaitlab::app
