// Compression by zlib.
#pragma once
#include <string>
#include <string_view>

namespace gaitlab::report {

inline constexpr int kMostDeflated = 9;  ///< compression level of zlib with the smallest output
/// Compresses bytes into zlib's format with a level from 0 to 9. The same version of zlib produces the same bytes. Throws
/// std::bad_alloc.
std::string deflated(std::string_view bytes, int level);

}  // namespace gaitlab::report
