// Tests of `gaitlab demo`.
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongDemo("Demo.WritesThePageOfAFeasibleGait", "long");

TEST(Demo, WritesThePageOfAFeasibleGait) {
  const Folder folder;
  const Result first = gaitlab("demo", folder / "");
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_TRUE(contains(first.out, "\n  verdict   feasible")) << first.out;
  EXPECT_TRUE(contains(first.out, "\n  page      runs/hexapod/report.html\n")) << first.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/hexapod/report.html"));
  // The second demo keeps the first, and each command that it prints can be run.
  const Result second = gaitlab("demo --out here", folder / "");
  EXPECT_TRUE(contains(second.out, "\n  page      here/report.html\n")) << second.out;
  const std::string command =
      "\n  " + std::string(build_folder()) + "/bin/gaitlab run";  // by the path of this call: PATH has no gaitlab
  const std::size_t at = second.out.find(command);
  ASSERT_NE(at, std::string::npos) << second.out;
  const std::size_t end = at + command.size();
  const Result offered = gaitlab("check" + second.out.substr(end, second.out.find('\n', end) - end), folder / "");
  EXPECT_EQ(offered.code, 0) << offered.err;
}

}  // namespace
}  // namespace gaitlab::test
