// In which lines two texts differ: scenarios as they were resolved, then and now.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// One sentence per line that was changed, added or removed, in the order of `now`: `line 136: "Kp: 97", was "Kp: 100"`, with
/// `nothing` for the side that has no such line. The number is that of the line in `now`; a removed line has that of the line
/// that now stands in its place. At most `most` sentences, and then one that counts the others.
std::vector<std::string> changed_lines(const std::string& then, const std::string& now, std::size_t most = 10);

}  // namespace gaitlab
