#include "core/recording/run_files.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

TEST(RunFiles, ADeepSummaryIsRefused) {
  const test::Folder folder;
  const auto summary = [&](std::size_t depth) {
    return folder.write("summary.json", "{\"wall_time\": " + std::string(depth, '[') + std::string(depth, ']') + "}");
  };
  const std::string file = summary(5);
  EXPECT_EQ(test::message_of([&] { static_cast<void>(read_summary(folder.path())); }), test::kNoError);
  for (const std::size_t depth : {20U, 500'000U}) {
    summary(depth);
    EXPECT_EQ(test::message_of([&] { static_cast<void>(read_summary(folder.path())); }),
              file + ": error: is nested deeper than any summary");
  }
}

}  // namespace
}  // namespace gaitlab
