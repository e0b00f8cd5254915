// Largest numbers of threads and lanes that commands and Python functions accept.
#pragma once
#include <cstddef>

namespace gaitlab {

inline constexpr int kMostThreads = 1024;
inline constexpr int kMostLanesAsked = 64;  ///< more lanes than any engine has, so that the same command suits later engines

}  // namespace gaitlab
