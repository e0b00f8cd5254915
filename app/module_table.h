// Properties of a module type, in the output of `gaitlab list module` and `explain module`.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::app {

/// Key properties for choosing a module, from a robot of one module: `65 x 65 x 130 mm  0.400 kg  2 hinges  1.97 N m`. Torque:
/// the largest of a hinge's motor at rest; `-` if no motor states it.
std::string module_row(const Scenario& one);

/// Size (the box around all shapes at zero angles, the smallest edge first), mass, hinges with their motors' torque at rest and
/// speed without load, faces with their connectors, the load limits of these, and the source of every part. Lines of at most
/// 100 characters, in the units of the user; degrees for ranges. `one`: a robot of one module.
std::string module_table(const Scenario& one);

}  // namespace gaitlab::app
