// Settings in which two resolved scenarios or studies differ.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// One entry per changed, added or removed setting, in the order of `now`, removed ones behind their section: `actuator.i_max:
/// 1.2 -> 0.45`, with `not set` for the side without it, `robot.docks[3]: ...` for an element of a list. At most `most`
/// entries, and then one with the number of the others. Gives changed lines (changed_lines.h) if a text is not YAML, or if only
/// the notation changed.
std::vector<std::string> changed_settings(const std::string& then, const std::string& now, std::size_t most = 10);

}  // namespace gaitlab
