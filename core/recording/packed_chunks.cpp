#include "core/recording/packed_chunks.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <new>
#include <vector>

namespace gaitlab {

namespace {

constexpr int kLevel = 1;  // level 2 takes 1.7 times as long and saves 4 % for a trace of a hexapod
constexpr std::size_t kBytes = sizeof(double);
constexpr std::size_t kTogether = 8;  // number of columns at once; together they fill a cache line
static_assert(std::endian::native == std::endian::little);

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};
struct FreeDecompressor {
  void operator()(libdeflate_decompressor* decompressor) const { libdeflate_free_decompressor(decompressor); }
};

/// True if the chunk has exactly the bytes of `to`, which receives them.
bool inflate(libdeflate_decompressor* decompressor, const PackedChunk& chunk, std::span<std::byte> to) {
  const std::span<const std::byte> from = chunk.bytes;
  if (!chunk.deflated) {
    if (from.size() == to.size()) std::ranges::copy(from, to.begin());
    return from.size() == to.size();
  }
  std::size_t consumed = 0;  // libdeflate requires that `to` is filled, because it gets no address for the size of the result
  return libdeflate_zlib_decompress_ex(decompressor, from.data(), from.size(), to.data(), to.size(), &consumed, nullptr) ==
             LIBDEFLATE_SUCCESS &&
         consumed == from.size();
}

/// Reassembles the bytes of the first values of a shuffled column.
void join(std::span<const std::byte> shuffled, std::span<double> values) {
  const std::size_t rows = shuffled.size() / kBytes;
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::array<std::byte, kBytes> bytes{};
    for (std::size_t b = 0; b < kBytes; ++b) bytes[b] = shuffled[b * rows + k];
    values[k] = std::bit_cast<double>(bytes);
  }
}

}  // namespace

void pack_chunks(const Trace& table, std::size_t rows, const TakeChunk& take) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(libdeflate_alloc_compressor(kLevel));
  if (compressor == nullptr) throw std::bad_alloc();
  const std::size_t columns = table.columns.size();
  const std::size_t size = rows * kBytes;
  std::vector<std::byte> shuffled(kTogether * size);
  std::vector<std::byte> packed(libdeflate_zlib_compress_bound(compressor.get(), size));
  for (std::size_t row = 0; row < table.rows(); row += rows) {
    const std::size_t count = std::min(rows, table.rows() - row);
    if (count < rows) std::ranges::fill(shuffled, std::byte{});
    for (std::size_t column = 0; column < columns; column += kTogether) {
      const std::size_t together = std::min(kTogether, columns - column);
      for (std::size_t k = 0; k < count; ++k) {
        const double* const values = &table.values[(row + k) * columns + column];
        for (std::size_t c = 0; c < together; ++c) {
          const auto bytes = std::bit_cast<std::array<std::byte, kBytes>>(values[c]);
          for (std::size_t b = 0; b < kBytes; ++b) shuffled[c * size + b * rows + k] = bytes[b];
        }
      }
      for (std::size_t c = 0; c < together; ++c) {
        const std::size_t length =
            libdeflate_zlib_compress(compressor.get(), &shuffled[c * size], size, packed.data(), packed.size());
        take(row, column + c, {packed.data(), length});
      }
    }
  }
}

std::optional<ChunkPlace> unpack_chunks(Trace& table, std::size_t count, std::size_t rows, const GiveChunk& give) {
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(libdeflate_alloc_decompressor());
  if (decompressor == nullptr) throw std::bad_alloc();
  const std::size_t columns = table.columns.size();
  const std::size_t size = rows * kBytes;
  std::vector<std::byte> shuffled(kTogether * size);
  std::array<std::vector<double>, kTogether> joined;
  joined.fill(std::vector<double>(rows));
  const std::size_t before = table.values.size();
  for (std::size_t row = 0; row < count; row += rows) {
    const std::size_t here = std::min(rows, count - row);
    table.values.resize(before + (row + here) * columns);
    for (std::size_t column = 0; column < columns; column += kTogether) {
      const std::size_t together = std::min(kTogether, columns - column);
      for (std::size_t c = 0; c < together; ++c) {
        if (!inflate(decompressor.get(), give(row, column + c), std::span(shuffled).subspan(c * size, size)))
          return ChunkPlace{row, column + c};
      }
      // One column at a time, because its bytes form eight streams, and a cache has eight places for addresses that are 4096
      // bytes apart.
      for (std::size_t c = 0; c < together; ++c)
        join(std::span(shuffled).subspan(c * size, size), std::span(joined[c]).first(here));
      for (std::size_t k = 0; k < here; ++k) {
        double* const values = &table.values[before + (row + k) * columns + column];
        for (std::size_t c = 0; c < together; ++c) values[c] = joined[c][k];
      }
    }
  }
  return {};
}

}  // namespace gaitlab
