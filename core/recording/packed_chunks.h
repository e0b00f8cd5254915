// Chunks of a table, packed like HDF5's filters shuffle and gzip do.
#pragma once
#include <cstddef>
#include <functional>
#include <span>

#include "core/recording/trace.h"

namespace gaitlab {

/// Receiver of a packed chunk of one column: its first row, its column, its bytes, which are valid during the call alone.
using TakeChunk = std::function<void(std::size_t row, std::size_t column, std::span<const std::byte> bytes)>;

/// Calls `take` for every chunk of `rows` values of one column, by row, then column. Layout: the lowest bytes of all values
/// first, then the second ones, and so on (shuffle), zeros beyond the last row; then zlib's format, by libdeflate at a fixed
/// level. A chunk that gzip does not shrink has stored blocks. The same table gives the same bytes with one version of
/// libdeflate. Throws std::bad_alloc, and exceptions of `take`.
void pack_chunks(const Trace& table, std::size_t rows, const TakeChunk& take);

}  // namespace gaitlab
