// Identity of this build: version, commit, compiler, and the libraries that influence the numbers.
#pragma once
#include <string>

namespace gaitlab {
/// Text such as `0.1.0+1a2b3c4 (GNU 12.2.0; Bullet 3.24, SLEEF 3.5.1)`. The commit ends with `.dirty` if the tree had changes.
std::string build_id();
/// True if the sources were those of the commit in build_id(): the commit is known, and the tree had no changes.
bool build_is_of_commit();
}  // namespace gaitlab
