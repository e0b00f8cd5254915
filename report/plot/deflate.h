// Compression by zlib.
#pragma once
#include <string>
#include <string_view>

namespace gaitlab::report {

inline constexpr int kMostDeflated = 9;  ///< zlib's level of the smallest output
/// The bytes in zlib's format, level 0 to 9; the same bytes for the same version of zlib. Throws std::bad_alloc.
std::string deflated(std::string_view bytes, int level);

}  // namespace gaitlab::report
