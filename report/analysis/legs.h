// Legs of a walking robot, and the names of its feet.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/plugin/legs.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Legs of a robot that walks: it has four or more legs (find_legs), contact elements and a ground. Empty for other robots.
std::vector<Leg> legs_that_walk(const Scenario& scenario);

/// Names of the legs, such as `m9 front left`: first module, place on its side (front, middle, rear; with more than three legs
/// front, 2nd, 3rd ... rear) and side. `legs` must be in the order of find_legs.
std::vector<std::string> leg_names(const std::vector<Leg>& legs);

/// Names of feet, given by the indices of their bodies: the name of the leg, followed by the body's name if the leg has several
/// feet. A foot outside the legs has its body's name.
std::vector<std::string> foot_names(const Scenario& scenario, std::span<const std::size_t> bodies);

}  // namespace gaitlab::report
