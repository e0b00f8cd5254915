// Which build of gaitlab this is: version, commit, compiler, and the libraries that the numbers rest on.
#pragma once
#include <string>

namespace gaitlab {
/// `0.1.0+1a2b3c4 (GNU 12.2.0; Bullet 3.24, SLEEF 3.5.1)`; `.dirty` behind the commit where the tree had changes.
std::string build_id();
}  // namespace gaitlab
