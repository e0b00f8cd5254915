// Chunks of a table, packed as by the HDF5 filters shuffle and gzip.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "core/recording/trace.h"

namespace gaitlab {

/// Receiver of a packed chunk of one column: first row, column, and bytes, which are valid only during the call.
using TakeChunk = std::function<void(std::size_t row, std::size_t column, std::span<const std::byte> bytes)>;

/// Calls `take` for every chunk of `rows` values of one column, by row, then column. A chunk contains the lowest bytes of all
/// values, then their second bytes, and so on (shuffle), with zeros after the last row of the table. It is compressed in the
/// format of zlib, by libdeflate at a fixed level. Lowest bytes that are noise, and chunks that gzip does not shrink, are
/// stored blocks. The same table gives the same bytes with one version of libdeflate. Throws std::bad_alloc, and exceptions of
/// `take`.
void pack_chunks(const Trace& table, std::size_t rows, const TakeChunk& take);

/// A packed chunk as stored in a file. HDF5 only shuffles a chunk that gzip would not shrink.
struct PackedChunk {
  std::span<const std::byte> bytes;
  bool deflated = true;
};

/// Function that returns the packed chunk that begins at a row of a column. The bytes are valid until the next call.
using GiveChunk = std::function<PackedChunk(std::size_t row, std::size_t column)>;

struct ChunkPlace {
  std::size_t row, column;
};

/// Appends `count` rows to `table`, whose columns are set, from chunks of `rows` values of one column. If a chunk does not have
/// exactly `rows` values, returns the place of the first such chunk and leaves the table unfinished. No declared size is
/// trusted: each chunk must be consumed whole and must fill its values to the last byte.
std::optional<ChunkPlace> unpack_chunks(Trace& table, std::size_t count, std::size_t rows, const GiveChunk& give);

}  // namespace gaitlab
