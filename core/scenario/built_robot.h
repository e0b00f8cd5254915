// The robot of a scenario as built, and its actuator.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Draws the differences of the robot from the drawings that are not stated, and builds the robot with them. `stated` is true
/// if the scenario has a section `as_built`. Returns a note if the tolerances draw nothing, else "".
std::string build_robot(Scenario& scenario, bool stated);

/// The actuator of scenarios with the same plugin, one lane each, with the constants of their motors as built
/// (core/scenario/as_built.h). A current limit that is the current at stall follows resistance and voltage limit. Null if the
/// scenarios have no actuator. Throws PluginError.
std::unique_ptr<Actuator> make_motors(std::span<const Scenario* const> lanes);
std::unique_ptr<Actuator> make_motors(const Scenario& scenario);

/// The reason why the differences of the motors cannot apply to the actuator, which make_motors() returned; empty if they can.
/// `of_motors` is a key of these differences, such as `tolerances.R`.
std::string not_buildable(const Scenario& scenario, const Actuator* actuator, const std::string& of_motors);

}  // namespace gaitlab
