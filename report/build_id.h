// Which build of gaitlab this is: version, commit, compiler.
#pragma once
#include <string>

namespace gaitlab {
/// `0.1.0+1a2b3c4 (g++ 12.2.0)`; `.dirty` behind the commit where the tree had changes.
std::string build_id();
}  // namespace gaitlab
