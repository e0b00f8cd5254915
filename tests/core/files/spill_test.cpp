#include "core/files/spill.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <new>
#include <optional>
#include <string>

#include "core/files/hash.h"
#include "tests/folder.h"

namespace gaitlab {
namespace {

constexpr std::size_t kMany = kMostInMemory / sizeof(std::uint64_t) + 12'345;

/// Sets TMPDIR, and puts the former value back.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& folder) {
    if (const char* const now = std::getenv("TMPDIR")) before_ = now;
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFolder() { before_ ? ::setenv("TMPDIR", before_->c_str(), 1) : ::unsetenv("TMPDIR"); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

 private:
  std::optional<std::string> before_;
};

/// Resident memory of this process in bytes.
long resident() {
  long all = 0;
  long pages = 0;
  std::ifstream("/proc/self/statm") >> all >> pages;
  return pages * sysconf(_SC_PAGESIZE);
}

TEST(Spill, KeepsItsContentWhilePagesLeaveMemory) {
  const long before = resident();
  SpilledVector<std::uint64_t> numbers;
  numbers.reserve(kMany);
  for (std::size_t k = 0; k < kMany; ++k) numbers.push_back(k * k);
  release(numbers);
  // The array of 200 MB has left memory. The tolerance, a fifth of it, is for memory that the process itself takes meanwhile.
  EXPECT_LT(resident(), before + 40'000'000);
  for (std::size_t k = 0; k < kMany; ++k) ASSERT_EQ(numbers[k], k * k);
}

TEST(Spill, GrowsFromMemoryIntoAFile) {
  SpilledVector<std::uint64_t> numbers(kMany / 2, 7);
  EXPECT_FALSE(Spilled<std::uint64_t>::in_file(numbers.capacity()));
  release(numbers);  // has no effect on an array in memory, whose content would be lost
  numbers.resize(kMany, 9);
  EXPECT_TRUE(Spilled<std::uint64_t>::in_file(numbers.capacity()));
  EXPECT_EQ(numbers[kMany / 2 - 1], 7U);
  EXPECT_EQ(numbers[kMany - 1], 9U);
}

TEST(Spill, LeavesNoFile) {
  const test::Folder folder;
  const TemporaryFolder here(folder.path().string());
  const SpilledVector<char> bytes(kMostInMemory + 1);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Spill, WithoutAFolderIsInMemory) {
  const TemporaryFolder nowhere("/nowhere");
  SpilledVector<char> bytes(kMostInMemory + 1);
  bytes.back() = 7;
  release(bytes);
  EXPECT_EQ(bytes.back(), 7);
}

TEST(Spill, BeyondTheDiskIsShortOfMemory) {
  SpilledVector<char> bytes;
  EXPECT_THROW(bytes.reserve(bytes.max_size() / 2), std::bad_alloc);
}

TEST(Spill, HasPartsThatAddUpToTheWhole) {
  SpilledVector<char> bytes((std::size_t{1} << 26) + 1001);
  for (std::size_t k = 0; k < bytes.size(); k += 977) bytes[k] = static_cast<char>(k);
  WordHash parts;
  parts.add_length(bytes.size());
  std::size_t count = 0;
  each_part(bytes, [&](std::string_view part) {
    parts.add_words(part);
    ++count;
  });
  EXPECT_EQ(count, 2U);
  EXPECT_EQ(parts.text(), hash_words({bytes.data(), bytes.size()}));
}

}  // namespace
}  // namespace gaitlab
