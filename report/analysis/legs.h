// Legs of a walking robot, and the names of its feet.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/plugin/legs.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Legs of a robot that walks: find_legs gives four or more, and contacts and a ground are on; else none.
std::vector<Leg> legs_that_walk(const Scenario& scenario);

/// Names of the legs: first module, place on its side counted from the front (front, middle, rear; with more than three front,
/// 2nd, 3rd ... rear) and side. `legs` in the order of find_legs.
std::vector<std::string> leg_names(const std::vector<Leg>& legs);

/// Names of feet, given by the numbers of their bodies: the leg's name, for a leg with several feet followed by the body's, and
/// without a leg the body's.
std::vector<std::string> foot_names(const Scenario& scenario, std::span<const std::size_t> bodies);

}  // namespace gaitlab::report
