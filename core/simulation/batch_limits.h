// Largest numbers of threads and lanes that commands and functions of Python accept.
#pragma once
#include <cstddef>

namespace gaitlab {

inline constexpr int kMostThreads = 1024;
inline constexpr int kMostLanesAsked = 64;  ///< more than any engine has, so that the same command fits later engines

}  // namespace gaitlab
