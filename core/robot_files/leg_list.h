// Legs that a scenario states: the key `legs` of the section `robot`.
#pragma once
#include <optional>
#include <vector>

#include "core/model/robot.h"
#include "core/settings/node.h"

namespace gaitlab {

inline constexpr const char* kLegs = "legs";

/// Reads a map NAME: BODY, with the last body of each leg, or the word `none`. Nothing, with problems, for anything else, and
/// if a body is part of the base, carries others, has no contact elements, or is moved by no motor.
std::optional<std::vector<StatedLeg>> read_legs(const Node& node, const Robot& robot, Problems& problems);

/// The legs as a value for a file.
Node legs_node(const Robot& robot);

}  // namespace gaitlab
