#include <fmt/format.h>
#include <libdeflate.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "core/files/number_table.h"

namespace gaitlab {

namespace {

[[noreturn]] void refuse_png(const std::string& found) {
  throw TableError(found + "; expected a PNG of 16 bit grey values without interlacing");
}

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t number = 0;
  for (const char byte : bytes.substr(0, 4)) number = (number << 8U) | static_cast<unsigned char>(byte);
  return number;
}

/// The chunks of a file in file order. Each checksum is verified.
class Chunks {
 public:
  explicit Chunks(std::string_view bytes) : rest_(bytes) {
    if (!rest_.starts_with(kPngMagic)) refuse_png("it does not begin as a PNG");
    rest_.remove_prefix(kPngMagic.size());
  }
  struct Chunk {
    std::string_view name, data;
  };
  Chunk next() {
    constexpr std::size_t kAround = 12;  // bytes of length, name and checksum
    if (rest_.size() < kAround) refuse_png("it ends too early");
    const std::size_t size = big_endian(rest_);
    if (size > rest_.size() - kAround) refuse_png("it ends too early");
    const std::string_view name_and_data = rest_.substr(4, 4 + size);
    if (libdeflate_crc32(0, name_and_data.data(), name_and_data.size()) != big_endian(rest_.substr(8 + size)))
      refuse_png("its checksum is wrong");
    rest_.remove_prefix(kAround + size);
    return {name_and_data.substr(0, 4), name_and_data.substr(4)};
  }

 private:
  std::string_view rest_;
};

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* one) const { libdeflate_free_decompressor(one); }
};

/// Decompressed data of exactly `size` bytes.
std::vector<unsigned char> inflated(const std::string& packed, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(libdeflate_alloc_decompressor());
  if (!decompressor) throw std::bad_alloc();
  std::vector<unsigned char> bytes(size);
  if (libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), bytes.data(), size, nullptr) !=
      LIBDEFLATE_SUCCESS)
    refuse_png("its picture is damaged");
  return bytes;
}

/// Paeth's predictor: the value among left, above and above left that is nearest to left + above - above left.
int nearest(int left, int above, int corner) {
  const int to_left = std::abs(above - corner);
  const int to_above = std::abs(left - corner);
  const int to_corner = std::abs(left + above - 2 * corner);
  if (to_left <= to_above && to_left <= to_corner) return left;
  return to_above <= to_corner ? above : corner;
}

/// Computes a row from its filtered bytes, which are differences from a prediction by neighbours. Each pixel has two bytes.
void unfilter(unsigned kind, unsigned char* row, const unsigned char* above, std::size_t size) {
  if (kind > 4) refuse_png("its picture is damaged");
  for (std::size_t i = 0; i < size; ++i) {
    const int a = i < 2 ? 0 : row[i - 2];
    const int b = above == nullptr ? 0 : above[i];
    const int c = i < 2 || above == nullptr ? 0 : above[i - 2];
    const int guess = kind == 1 ? a : kind == 2 ? b : kind == 3 ? (a + b) / 2 : kind == 4 ? nearest(a, b, c) : 0;
    row[i] = static_cast<unsigned char>(row[i] + guess);
  }
}

}  // namespace

NumberTable read_grey_png(std::string_view bytes, std::size_t most) {
  Chunks chunks(bytes);
  const Chunks::Chunk first = chunks.next();
  const std::string_view head = first.data;
  constexpr std::size_t kHead = 13;
  if (first.name != "IHDR" || head.size() != kHead) refuse_png("it lacks the header of a PNG");
  const auto at = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(head[i])); };
  const unsigned depth = at(8);
  const unsigned colour = at(9);
  if (colour != 0) refuse_png(colour == 4 ? "it is grey with transparency" : "it is in colour");
  if (depth != 16) refuse_png(fmt::format("it has {} bit", depth));
  if (at(12) != 0) refuse_png("it is interlaced");
  if (at(10) != 0 || at(11) != 0) refuse_png("its compression or filter method is unknown");
  NumberTable table{big_endian(head.substr(4)), big_endian(head), {}};
  if (table.rows == 0 || table.columns == 0) refuse_png("it is empty");
  if (table.rows > most / table.columns) {
    throw TableError(
        fmt::format("it has {} rows of {} grey values; expected at most {} in all", table.rows, table.columns, most));
  }
  std::string packed;
  for (;;) {
    const auto [name, data] = chunks.next();
    if (name == "IEND") break;
    if (name == "IDAT") packed += data;
    const bool critical = (static_cast<unsigned char>(name[0]) & 0x20U) == 0;
    if (critical && name != "IDAT") refuse_png("it has a chunk that grey PNGs do not have");
  }
  const std::size_t size = 2 * table.columns;
  std::vector<unsigned char> picture = inflated(packed, table.rows * (1 + size));
  table.values.reserve(table.rows * table.columns);
  const unsigned char* above = nullptr;
  for (std::size_t y = 0; y < table.rows; ++y) {
    unsigned char* row = &picture[y * (1 + size)];
    unfilter(row[0], row + 1, above, size);
    above = row + 1;
    for (std::size_t x = 0; x < table.columns; ++x) table.values.push_back(256.0 * row[1 + 2 * x] + row[2 + 2 * x]);
  }
  return table;
}

}  // namespace gaitlab
