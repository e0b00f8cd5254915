// Every reader accepts or refuses the inputs that the fuzzer has kept in tests/fuzz/corpus/READER/.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/folders.h"
#include "tests/fuzz/readers.h"

namespace gaitlab::test {
namespace {

TEST(Corpus, NoFileEndsAReaderButByAMessage) {
  for (const fuzz::Reader& reader : fuzz::kReaders) {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path corpus =
        std::filesystem::path(gaitlab::test::source_folder()) / "tests/fuzz/corpus" / reader.name;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) files.push_back(entry.path());
    std::ranges::sort(files);
    EXPECT_FALSE(files.empty()) << reader.name;
    for (const std::filesystem::path& file : files) {
      SCOPED_TRACE(file.string());
      EXPECT_NO_THROW(fuzz::take(reader, read(file.string())));
    }
  }
}

// Every reader accepts its seed. Otherwise the fuzzer would test only the first check of the reader.
TEST(Corpus, EveryReaderTakesItsSeed) {
  for (const fuzz::Reader& reader : fuzz::kReaders) {
    SCOPED_TRACE(reader.name);
    EXPECT_NO_THROW(reader.read(
        read(std::string(gaitlab::test::source_folder()) + "/tests/fuzz/corpus/" + std::string(reader.name) + "/seed")));
  }
}

}  // namespace
}  // namespace gaitlab::test
