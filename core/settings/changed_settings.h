// The settings in which two scenarios or studies differ: texts as they were resolved, then and now.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// One entry per setting that was changed, added or removed, in the order of `now`, what was removed behind its section:
/// `actuator.i_max: 1.2 -> 0.45`, with `not set` for the side that lacks it, `robot.docks[3]: ...` for an element of a list.
/// At most `most` entries, and then one that counts the others. Changed lines (changed_lines.h) where a text is not YAML, or
/// where only its writing changed.
std::vector<std::string> changed_settings(const std::string& then, const std::string& now, std::size_t most = 10);

}  // namespace gaitlab
