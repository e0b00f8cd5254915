// The robot of a scenario as built, and its actuator.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Draws all differences from the drawings that the scenario does not state, and builds the robot with these differences.
/// `stated` is true if the scenario has a section `as_built`. Returns a note if the tolerances draw nothing, else "".
std::string build_robot(Scenario& scenario, bool stated);

/// Actuator for scenarios with the same plugin, one lane each, with motor constants as built (core/scenario/as_built.h). If the
/// current limit is the current at stall, it changes with the resistance. Directional gears jump at rest if the
/// integrator is implicit (core/laws/dc_motor.h). Null if the scenarios have no actuator.
/// Throws PluginError.
std::unique_ptr<Actuator> make_motors(std::span<const Scenario* const> lanes);
std::unique_ptr<Actuator> make_motors(const Scenario& scenario);

/// Reason why the differences of the motors cannot be applied to the actuator that make_motors() returned; empty if they can.
/// `of_motors` is a key of these differences, such as `tolerances.R`.
std::string not_buildable(const Scenario& scenario, const Actuator* actuator, const std::string& of_motors);

/// Joint whose play as built is not less than its range, as a reason; empty if there is none. `of_gears`: as above.
std::string too_much_play(const Scenario& scenario, const std::string& of_gears);

}  // namespace gaitlab
