// Properties of a module type, as `gaitlab list module` and `gaitlab explain module` print them.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::app {

/// Size of a robot, the edges of the box around all its shapes at zero angles, the smallest first: `65 x 65 x 130 mm`.
std::string size_text(const Robot& robot);

/// One line for choosing a module: `65 x 65 x 130 mm  0.400 kg  2 hinges  1.97 N m`. The torque is the largest torque at rest
/// of a hinge's motor, or `-` if no motor states its torque. `one` is a robot of one module.
std::string module_row(const Scenario& one);

/// Table of a module type: size (smallest edge first; box around all shapes at zero angles), mass, bodies with their inertia,
/// hinges with torque at rest and no-load speed of their motors, faces with their connectors and load limits, and the sources
/// of these numbers. Lines have at most 100 characters. Units are those of the user, with degrees for ranges. `one` is a robot
/// of one module.
std::string module_table(const Scenario& one);

}  // namespace gaitlab::app
