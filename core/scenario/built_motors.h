// The actuator of a robot as built.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// The actuator of scenarios with the same plugin, one lane each, with the constants of their motors as built
/// (core/scenario/as_built.h). A current limit that is the current at stall follows resistance and voltage limit. Null if the
/// scenarios have no actuator. Throws PluginError.
std::unique_ptr<Actuator> make_motors(std::span<const Scenario* const> lanes);
std::unique_ptr<Actuator> make_motors(const Scenario& scenario);

/// The reason why the differences of the motors cannot apply to the actuator, which make_motors() returned; empty if they can.
/// `of_motors` is a key of these differences, such as `tolerances.R`.
std::string not_buildable(const Scenario& scenario, const Actuator* actuator, const std::string& of_motors);

}  // namespace gaitlab
