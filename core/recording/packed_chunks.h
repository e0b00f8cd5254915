// Chunks of a table, packed as HDF5's filters shuffle and gzip pack them.
#pragma once
#include <cstddef>
#include <functional>
#include <span>

#include "core/recording/trace.h"

namespace gaitlab {

/// What takes a packed chunk of one column: its first row, its column, its bytes, which are valid during the call alone.
using TakeChunk = std::function<void(std::size_t row, std::size_t column, std::span<const std::byte> bytes)>;

/// Calls `take` for every chunk of `rows` values of one column, by row, then column. Of each value the lowest bytes come first,
/// then the second ones, and so on (shuffle); beyond the last row are zeros; then zlib's format, by libdeflate at a fixed
/// level. A chunk that gzip does not make smaller is one of stored blocks. The same table, the same bytes, with one version of
/// libdeflate. Throws std::bad_alloc, and what `take` throws.
void pack_chunks(const Trace& table, std::size_t rows, const TakeChunk& take);

}  // namespace gaitlab
