#include "core/recording/packed_chunks.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <random>

namespace gaitlab {
namespace {

struct Chunk {
  std::size_t row, column, packed;
  std::vector<double> values;
};

// Chunks unpacked by zlib and the inverse of shuffle, independently of the writer.
std::vector<Chunk> unpacked(const Trace& table, std::size_t rows) {
  std::vector<Chunk> all;
  pack_chunks(table, rows, [&](std::size_t row, std::size_t column, std::span<const std::byte> packed) {
    std::vector<unsigned char> shuffled(rows * sizeof(double) + 1);  // one byte too many, which must remain unused
    uLongf size = shuffled.size();
    ASSERT_EQ(uncompress(shuffled.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()), Z_OK);
    ASSERT_EQ(size, rows * sizeof(double));
    Chunk chunk{row, column, packed.size(), std::vector<double>(rows)};
    for (std::size_t k = 0; k < rows; ++k) {
      unsigned char bytes[sizeof(double)];
      for (std::size_t b = 0; b < sizeof(double); ++b) bytes[b] = shuffled[b * rows + k];
      std::memcpy(&chunk.values[k], bytes, sizeof(double));
    }
    all.push_back(std::move(chunk));
  });
  return all;
}

// Table with t, a constant column, and `noise` columns of which every byte is random.
Trace table(std::size_t rows, std::size_t noise) {
  std::mt19937_64 random(1);
  Trace made;
  made.columns = {{"t", "s", ""}, {"constant", "", ""}};
  for (std::size_t c = 0; c < noise; ++c) made.columns.push_back({"c" + std::to_string(c), "", ""});
  for (std::size_t k = 0; k < rows; ++k) {
    made.values.insert(made.values.end(), {0.005 * static_cast<double>(k), -0.0325});
    for (std::size_t c = 0; c < noise; ++c) {
      const std::uint64_t bits = random() & ~(std::uint64_t{1} << 62U);  // avoids NaN, which is not equal to itself
      double value = 0;
      std::memcpy(&value, &bits, sizeof value);
      made.values.push_back(value);
    }
  }
  return made;
}

TEST(PackedChunks, HoldEveryValueOfTheirColumnByRowThenColumn) {
  constexpr std::size_t kRows = 100;
  for (const std::size_t noise : {0U, 5U, 6U, 7U, 15U}) {  // whole groups of columns, and one more or less
    const Trace whole = table(250, noise);
    const std::vector<Chunk> chunks = unpacked(whole, kRows);
    ASSERT_EQ(chunks.size(), 3 * whole.columns.size());
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      EXPECT_EQ(chunks[i].row, i / whole.columns.size() * kRows);
      EXPECT_EQ(chunks[i].column, i % whole.columns.size());
      for (std::size_t k = 0; k < kRows; ++k) {
        const std::size_t row = chunks[i].row + k;
        ASSERT_EQ(chunks[i].values[k], row < whole.rows() ? whole.at(row, chunks[i].column) : 0.0) << i << ' ' << row;
      }
    }
  }
}

TEST(PackedChunks, AreSmallWhereTheyCanBeAndBarelyLargerWhereNot) {
  constexpr std::size_t kRows = 4096;
  const std::vector<Chunk> chunks = unpacked(table(kRows, 1), kRows);
  ASSERT_EQ(chunks.size(), 3U);
  EXPECT_LT(chunks[1].packed, kRows * sizeof(double) / 100);  // constant column
  // The overhead is two bytes of header, four of checksum, and five per stored block of at most 65535 bytes.
  EXPECT_LE(chunks[2].packed, kRows * sizeof(double) + 2 + 4 + 2UL * 5);
}

TEST(PackedChunks, MayHaveNoiseOfSeveralStoredBlocks) {
  constexpr std::size_t kRows = 20000;  // seven bytes of noise of each value are more than a stored block can hold
  const Trace whole = table(kRows, 1);
  const std::vector<Chunk> chunks = unpacked(whole, kRows);
  ASSERT_EQ(chunks.size(), 3U);
  for (std::size_t k = 0; k < kRows; ++k) ASSERT_EQ(chunks[2].values[k], whole.at(k, 2));
  // The highest bytes have seven bits of noise. 5 % of them for the deflated block.
  EXPECT_LE(chunks[2].packed, kRows * 7 + kRows * 7 / 8 + kRows / 20);
}

// Chunks as a writer gives them, to be unpacked again.
struct Packed {
  std::vector<std::vector<std::byte>> chunks;
  bool deflated = true;
};

Packed packed(const Trace& table, std::size_t rows) {
  Packed made;
  pack_chunks(table, rows, [&](std::size_t, std::size_t, std::span<const std::byte> bytes) {
    made.chunks.emplace_back(bytes.begin(), bytes.end());
  });
  return made;
}

std::optional<ChunkPlace> unpack(const Packed& from, Trace& to, std::size_t count, std::size_t rows) {
  std::size_t next = 0;
  return unpack_chunks(to, count, rows, [&](std::size_t, std::size_t) {
    return PackedChunk{from.chunks.at(next++), from.deflated};
  });
}

TEST(PackedChunks, AreUnpackedBitForBit) {
  constexpr std::size_t kRows = 100;
  for (const std::size_t noise : {0U, 5U, 6U, 7U, 15U}) {
    for (const std::size_t count : {1U, 99U, 100U, 101U, 250U}) {
      const Trace whole = table(count, noise);
      Trace read{whole.columns, {}};
      ASSERT_FALSE(unpack(packed(whole, kRows), read, count, kRows));
      ASSERT_EQ(read.values.size(), whole.values.size());
      EXPECT_EQ(std::memcmp(read.values.data(), whole.values.data(), whole.values.size() * sizeof(double)), 0);
    }
  }
}

TEST(PackedChunks, OfAnotherSizeAreNotUnpacked) {
  const Trace whole = table(100, 1);
  for (const std::size_t rows : {1U, 99U, 101U, 200U}) {  // shorter and longer than the chunks of 100 rows are
    Trace read{whole.columns, {}};
    const auto wrong = unpack(packed(whole, 100), read, rows, rows);
    ASSERT_TRUE(wrong);
    EXPECT_EQ(wrong->column, 0U);
  }
  Packed longer = packed(whole, 100);
  longer.chunks[2].push_back(std::byte{});  // behind the end of the stream
  Trace read{whole.columns, {}};
  const auto wrong = unpack(longer, read, 100, 100);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->column, 2U);
}

TEST(PackedChunks, OfHdf5MayBeShuffledOnly) {
  Packed raw{{std::vector<std::byte>(16)}, false};
  raw.chunks[0][15] = std::byte{0x40};  // the highest byte of the second value
  raw.chunks[0][1] = std::byte{1};      // the lowest byte of the second value
  Trace read{{{"t", "s", ""}}, {}};
  ASSERT_FALSE(unpack(raw, read, 2, 2));
  EXPECT_EQ(read.values[0], 0.0);
  EXPECT_EQ(read.values[1], std::nextafter(2.0, 3.0));
  raw.chunks[0].pop_back();
  EXPECT_TRUE(unpack(raw, read, 2, 2));
}

TEST(PackedChunks, OfNoRowsAreNone) { EXPECT_TRUE(unpacked(table(0, 2), 1).empty()); }

}  // namespace
}  // namespace gaitlab
