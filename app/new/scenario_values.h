// Values of a new scenario that suit a module type: the length of the row, its gait and its ground.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::app {

/// Largest number of modules in a row, at most `most`, whose weight the weakest motor holds with half its torque at rest. A row
/// that rests on its ends or on its middle is bent by the torque W L / 8 (a beam of length L under its own weight W). Returns
/// `most` for modules without shapes or motor data. `one` is a scenario of one module.
int modules_carried(const Scenario& one, int most);

/// The gait as texts of a scenario.
struct GaitValues {
  std::string frequency, amplitude, offset, angles, duration;
};

/// A gait of sines of `amplitude` (rad) or less within the ranges of the hinges, whose set points move at up to half the
/// no-load speed of the slowest motor. Hinges without a range stand still if others have a range.
GaitValues gait_values(const Scenario& one, double amplitude);

/// Base and ground as texts of a scenario: a ground on which `modules` modules sink by at most 1 mm at rest, or a fixed base
/// for a module that touches nothing.
struct Surroundings {
  std::string base, ground;
};
Surroundings surroundings(const ModuleType& type, int modules);

}  // namespace gaitlab::app
