// Build files (.dat) with the docks of a robot, and the same list within a scenario.
#pragma once
#include <string>
#include <vector>

#include "core/model/robot.h"
#include "core/settings/node.h"

namespace gaitlab {

inline constexpr int kMaxModule = 100000;  ///< largest module number, so that a short text cannot define a huge robot

/// Reads rows of five whole numbers: child_face child_module parent_face parent_module orientation. Blank lines and # comments
/// are allowed. The place of a row is the place of its first number.
std::vector<Dock> read_build(const std::string& text, const std::string& file, Problems& problems);

/// Reads docks from a list whose elements are lists of five numbers, or maps with the five keys of read_build().
std::vector<Dock> read_docks(const Node& node, Problems& problems);

}  // namespace gaitlab
