// Lines in which two texts differ, such as the resolved scenarios of two runs.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// One sentence per changed, added or removed line, in the order of `now`, as in `line 136: "Kp: 97", was "Kp: 100"`. The word
/// `nothing` replaces a line that one text lacks. The number is the line number in `now`; for a removed line, it is the number
/// of the line now in this place. After `most` sentences, a last sentence contains the number of the omitted ones.
std::vector<std::string> changed_lines(const std::string& then, const std::string& now, std::size_t most = 10);

}  // namespace gaitlab
