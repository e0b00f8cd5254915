#include "core/recording/packed_chunks.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
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

/// Number of leading bytes of a shuffled chunk that gzip would not shrink: whole planes (the lowest bytes of all values, then
/// their second bytes ...) in which two bytes are equal hardly more often than by chance.
std::size_t noise(std::span<const std::byte> shuffled, std::size_t rows) {
  constexpr double kByChance = 1.0 / 256;
  constexpr double kMore = 1.5;  // 7.4 bits of a byte; traces are as small as with 1.1, and with 2 larger by 0.5 %
  const double pairs = static_cast<double>(rows) * (static_cast<double>(rows) - 1);
  for (std::size_t from = 0; from < shuffled.size(); from += rows) {
    std::array<std::uint32_t, 256> count{};
    for (const std::byte byte : shuffled.subspan(from, rows)) ++count[std::to_integer<std::size_t>(byte)];
    double equal = 0;
    for (const std::uint32_t each : count) equal += static_cast<double>(each) * (static_cast<double>(each) - 1);
    if (!(equal < kMore * kByChance * pairs)) return from;
  }
  return shuffled.size();
}

/// Compresses chunks of `rows` values: noise in stored blocks, the rest by libdeflate.
class Compressor {
 public:
  explicit Compressor(std::size_t rows)
      : rows_(rows),
        deflate_(libdeflate_alloc_compressor(kLevel)),
        packed_(kHeader.size() + libdeflate_zlib_compress_bound(deflate_.get(), rows * kBytes) +
                kBlockHeader * (1 + rows * kBytes / kLongestBlock)) {
    if (deflate_ == nullptr) throw std::bad_alloc();
  }

  /// The chunk in the format of zlib, valid until the next call.
  std::span<const std::byte> pack(std::span<const std::byte> shuffled) {
    const std::size_t stored = noise(shuffled, rows_);
    std::size_t end = 0;
    const auto put = [&](std::span<const std::byte> bytes) {
      std::ranges::copy(bytes, packed_.begin() + static_cast<std::ptrdiff_t>(end));
      end += bytes.size();
    };
    put(kHeader);
    for (std::size_t from = 0; from < stored; from += kLongestBlock) {
      const std::size_t length = std::min(kLongestBlock, stored - from);
      const auto low = static_cast<std::byte>(length & 0xFFU);
      const auto high = static_cast<std::byte>(length >> 8U);
      put(std::array{std::byte{0}, low, high, ~low, ~high});  // not the last block, stored (RFC 1951, 3.2.4)
      put(shuffled.subspan(from, length));
    }
    end += libdeflate_deflate_compress(deflate_.get(), shuffled.data() + stored, shuffled.size() - stored, &packed_[end],
                                       packed_.size() - end);
    const std::uint32_t sum = libdeflate_adler32(1, shuffled.data(), shuffled.size());
    for (const unsigned shift : {24U, 16U, 8U, 0U}) packed_[end++] = static_cast<std::byte>(sum >> shift);
    return std::span(packed_).first(end);
  }

 private:
  static constexpr std::array kHeader{std::byte{0x78}, std::byte{0x01}};  // deflate, window of 32 kB, fastest level (RFC 1950)
  static constexpr std::size_t kLongestBlock = 65535, kBlockHeader = 5;
  std::size_t rows_;
  std::unique_ptr<libdeflate_compressor, FreeCompressor> deflate_;
  std::vector<std::byte> packed_;
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
  Compressor compressor(rows);
  const std::size_t columns = table.columns.size();
  const std::size_t size = rows * kBytes;
  std::vector<std::byte> shuffled(kTogether * size);
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
      for (std::size_t c = 0; c < together; ++c)
        take(row, column + c, compressor.pack(std::span(shuffled).subspan(c * size, size)));
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
