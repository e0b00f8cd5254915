// Lines in which two texts differ: the resolved scenarios of two runs.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// One sentence per changed, added or removed line, in the order of `now`: `line 136: "Kp: 97", was "Kp: 100"`, with `nothing`
/// for the side without that line. The number is that of the line in `now`; for a removed line, that of the line now in its
/// place. At most `most` sentences, and then one with the number of the others.
std::vector<std::string> changed_lines(const std::string& then, const std::string& now, std::size_t most = 10);

}  // namespace gaitlab
