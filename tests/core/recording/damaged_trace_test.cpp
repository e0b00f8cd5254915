#include "tests/core/recording/damaged_trace.h"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <optional>

#include "core/errors.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

using test::ChunkEntry;

class DamagedTrace : public testing::Test {
 protected:
  /// Text of the error for a file with these bytes and a valid signature. Nothing if the file can be read; `stored` is then its
  /// content.
  std::optional<std::string> complaint(const std::string& bytes) {
    const std::string file = folder_.write("damaged.h5", test::sealed(bytes));
    const std::string text = test::message_of([&] { stored_ = read_h5(file); });
    if (text == test::kNoError) return {};
    EXPECT_TRUE(text.starts_with(file + ": error: is corrupt: ")) << text;
    return text;
  }
  /// Requires an error that names a dataset.
  void expect_named(const std::string& bytes, const std::string& what) {
    const auto text = complaint(bytes);
    ASSERT_TRUE(text) << what;
    EXPECT_NE(text->find(": dataset /"), std::string::npos) << what << ": " << *text;
  }
  /// Every number of the file that was read last, in the order of its tables, as bits.
  [[nodiscard]] std::vector<std::uint64_t> numbers() const {
    std::vector<std::uint64_t> all;
    const auto add = [&](const Trace& table) {
      EXPECT_EQ(table.values.size(), table.rows() * table.columns.size());
      for (const double value : table.values) all.push_back(std::bit_cast<std::uint64_t>(value));
    };
    add(stored_.trace);
    for (const Beside& one : stored_.beside) add(one.table);
    return all;
  }
  std::size_t draw(std::size_t below) { return std::uniform_int_distribution<std::size_t>(0, below - 1)(random_); }
  const ChunkEntry& any_entry() { return entries_[draw(entries_.size())]; }

  const test::Folder folder_;
  const std::string whole_ = test::whole_trace(folder_ / "whole.h5");
  const std::vector<ChunkEntry> entries_ = test::chunk_entries(whole_);
  std::mt19937_64 random_{51};
  StoredTrace stored_;
};

/// Bytes of the values of a chunk: 4096 or all rows of its table.
std::size_t chunk_bytes(const std::string& bytes, const ChunkEntry& entry) {
  const std::string whole = bytes.substr(test::chunk_place(bytes, entry));
  std::vector<unsigned char> values(std::size_t{1} << 16);
  uLongf size = values.size();
  EXPECT_EQ(uncompress(values.data(), &size, reinterpret_cast<const Bytef*>(whole.data()), whole.size()), Z_OK);
  return size;
}

/// Each chunk of each dataset is replaced by one that unpacks to another number of bytes than declared.
TEST_F(DamagedTrace, AChunkOfAnotherSizeIsRefused) {
  ASSERT_EQ(entries_.size(), 2 * 3 + 3 * std::size(kBeside));
  ASSERT_FALSE(complaint(whole_));
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const std::size_t right = chunk_bytes(whole_, entries_[k]);
    for (const std::size_t size : {std::size_t{0}, std::size_t{8}, right - 1, right + 1, 2 * right}) {
      std::string bytes = whole_;
      ASSERT_TRUE(test::replace_chunk(bytes, entries_[k], size));
      expect_named(bytes, "chunk " + std::to_string(k) + " of " + std::to_string(size) + " bytes");
    }
  }
}

/// A chunk of another writer that has the declared size is read, and changes only its own values.
TEST_F(DamagedTrace, AChunkOfTheRightSizeIsRead) {
  ASSERT_FALSE(complaint(whole_));
  const std::vector<std::uint64_t> before = numbers();
  std::string bytes = whole_;
  const std::size_t size = chunk_bytes(bytes, entries_.back());
  ASSERT_TRUE(test::replace_chunk(bytes, entries_.back(), size));
  ASSERT_FALSE(complaint(bytes));
  std::size_t changed = 0;
  const std::vector<std::uint64_t> after = numbers();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i] == before[i]) continue;
    EXPECT_EQ(after[i], 0U);
    ++changed;
  }
  EXPECT_EQ(changed, size / sizeof(double));
}

/// Sizes, filters, places and addresses in the index of the chunks.
TEST_F(DamagedTrace, AnotherIndexIsRefused) {
  for (std::size_t k = 0; k < entries_.size(); k += 3) {  // every dataset, and both chunks of the trace's columns
    const ChunkEntry& entry = entries_[k];
    const auto size = test::number_at<std::uint32_t>(whole_, entry.at);
    for (const std::uint32_t other : {0U, 1U, size - 1, size + 1, 1U << 30U, ~0U}) {
      std::string bytes = whole_;
      test::put_number(bytes, entry.at, other);
      expect_named(bytes, "size " + std::to_string(other));
    }
    for (const std::uint32_t mask : {1U, 2U, 3U, 4U, ~0U}) {
      std::string bytes = whole_;
      test::put_number(bytes, entry.at + ChunkEntry::kMask, mask);
      expect_named(bytes, "filters " + std::to_string(mask));
    }
    for (const std::uint64_t address :
         {std::uint64_t{0}, std::uint64_t{whole_.size()}, ~std::uint64_t{0} >> 1U, ~std::uint64_t{0}}) {
      std::string bytes = whole_;
      test::put_number(bytes, entry.at + ChunkEntry::kAddress, address);
      expect_named(bytes, "address " + std::to_string(address));
    }
  }
}

/// Files with random damage of any kind are refused, or read twice with the same numbers, as many as declared.
TEST_F(DamagedTrace, AnyDamageIsAnErrorOrTheNumbersOfTheFile) {
  const std::vector<std::function<void(std::string&)>> kinds{
      [&](std::string& bytes) {  // flips bits, half of them among the structures of HDF5 at the start
        for (std::size_t k = 0, bits = 1 + draw(8); k < bits; ++k) {
          const std::size_t end = draw(2) == 0 ? std::min<std::size_t>(bytes.size(), 8192) : bytes.size();
          bytes[kUserBlock + draw(end - kUserBlock)] ^= static_cast<char>(1U << draw(8));
        }
      },
      [&](std::string& bytes) { bytes[any_entry().at + draw(ChunkEntry::kBytes)] = static_cast<char>(draw(256)); },
      [&](std::string& bytes) {  // gives an entry the address of another chunk
        test::put_number(bytes, any_entry().at + ChunkEntry::kAddress,
                         test::number_at<std::uint64_t>(bytes, any_entry().at + ChunkEntry::kAddress));
      },
      [&](std::string& bytes) { bytes.resize(kUserBlock + draw(bytes.size() - kUserBlock)); },
      [&](std::string& bytes) {  // fills a block with one byte
        const std::size_t from = kUserBlock + draw(bytes.size() - kUserBlock);
        const std::size_t count = std::min(bytes.size() - from, 1 + draw(4096));
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(from), count, static_cast<char>(draw(256)));
      },
      [&](std::string& bytes) { test::replace_chunk(bytes, any_entry(), draw(70000)); }};
  constexpr std::size_t kDraws = 300;
  std::size_t read = 0;
  for (std::size_t k = 0; k < kDraws; ++k) {
    std::string bytes = whole_;
    kinds[k % kinds.size()](bytes);
    if (complaint(bytes)) continue;
    ++read;
    const std::vector<std::uint64_t> first = numbers();
    ASSERT_FALSE(complaint(bytes));
    EXPECT_EQ(numbers(), first) << "draw " << k;
  }
  EXPECT_LT(read, kDraws / 2);  // most damages are refused
}

}  // namespace
}  // namespace gaitlab
