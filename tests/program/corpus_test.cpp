// Inputs that the fuzzer kept, read again: tests/fuzz/corpus/READER/.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/fuzz/readers.h"

namespace gaitlab::test {
namespace {

TEST(Corpus, NoFileEndsAReaderButByAMessage) {
  for (const fuzz::Reader& reader : fuzz::kReaders) {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path corpus = std::filesystem::path(GAITLAB_SOURCE_DIR) / "tests/fuzz/corpus" / reader.name;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) files.push_back(entry.path());
    std::ranges::sort(files);
    EXPECT_FALSE(files.empty()) << reader.name;
    for (const std::filesystem::path& file : files) {
      SCOPED_TRACE(file.string());
      EXPECT_NO_THROW(fuzz::take(reader, read(file.string())));
    }
  }
}

// Without a seed that is taken a reader is tested no further than its first check.
TEST(Corpus, EveryReaderTakesItsSeed) {
  for (const fuzz::Reader& reader : fuzz::kReaders) {
    SCOPED_TRACE(reader.name);
    EXPECT_NO_THROW(
        reader.read(read(std::string(GAITLAB_SOURCE_DIR) + "/tests/fuzz/corpus/" + std::string(reader.name) + "/seed")));
  }
}

}  // namespace
}  // namespace gaitlab::test
