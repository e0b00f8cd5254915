// The legs of a robot that walks on them, and the names of its feet.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/plugin/legs.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// The legs of a robot that walks on them: find_legs gives four or more, contacts and a ground are on; else none.
std::vector<Leg> legs_that_walk(const Scenario& scenario);

/// A name for each leg: its first module, its place on its side counted from the front (front, middle, rear; with more than
/// three front, 2nd, 3rd ... rear) and the side. `legs` as find_legs orders them.
std::vector<std::string> leg_names(const std::vector<Leg>& legs);

/// A name for each foot, given by the number of its body: that of its leg, of a leg with several feet that of the body behind
/// it, and without a leg that of the body.
std::vector<std::string> foot_names(const Scenario& scenario, std::span<const std::size_t> bodies);

}  // namespace gaitlab::report
