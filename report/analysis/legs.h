// Legs of a walking robot, and the names of its feet.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Legs of a robot without a fixed base, with contact elements and a ground. Empty for other robots.
std::vector<Leg> legs_that_walk(const Scenario& scenario);

/// Name of a leg for people: `front left`.
std::string leg_name(const Leg& leg);

/// Numbers of the modules with joints in this leg alone.
std::vector<std::size_t> own_modules(const RobotInfo& robot, const Leg& leg);

/// Names of feet, given by the indices of their bodies: the name of the leg, followed by the body's name if the leg has several
/// feet. A foot outside the legs has its body's name.
std::vector<std::string> foot_names(const Scenario& scenario, std::span<const std::size_t> bodies);

}  // namespace gaitlab::report
