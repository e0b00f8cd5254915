// Settings in which two resolved scenarios or studies differ.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// One entry per changed, added or removed setting, in the order of `now`, with removed settings after their section. Examples
/// are `actuator.i_max: 1.2 -> 0.45`, and `robot.docks[3]: ...` for an element of a list. The words `not set` replace a value
/// that one text lacks. After `most` entries, a last entry contains the number of the omitted ones. If a text is not YAML, or
/// if only the notation changed, the entries are those of changed_lines().
std::vector<std::string> changed_settings(const std::string& then, const std::string& now, std::size_t most = 10);

}  // namespace gaitlab
