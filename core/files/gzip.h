// Compression of a file by gzip (RFC 1952).
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace gaitlab {

inline constexpr std::string_view kGzipMagic = "\x1f\x8b";

/// The bytes as a gzip file. The file contains no name or time, so that equal bytes give equal files.
std::string gzip(std::string_view bytes);

/// The bytes in a gzip file of one member. Throws TableError for damaged files, and for more than `most` bytes before any
/// memory is allocated.
std::string gunzip(std::string_view packed, std::size_t most);

}  // namespace gaitlab
