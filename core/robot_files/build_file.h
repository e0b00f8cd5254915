// Build files (.dat), which list how modules are docked, and the same rows inline.
#pragma once
#include <string>
#include <vector>

#include "core/model/robot.h"
#include "core/settings/node.h"

namespace gaitlab {

inline constexpr int kMaxModule = 100000;  ///< largest module number, so that a small text cannot describe a huge robot

/// Rows of five whole numbers: child_face child_module parent_face parent_module orientation. Blank lines and # comments are
/// allowed. The place of a row is that of its first number.
std::vector<Dock> read_build(const std::string& text, const std::string& file, Problems& problems);

/// The same rows as a list of five-number lists or of maps with these five keys.
std::vector<Dock> read_docks(const Node& node, Problems& problems);

}  // namespace gaitlab
