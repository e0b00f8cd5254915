// Tests of the second, more accurate run that replaces a run without a verdict, and of the command that leads to a verdict.
#include <filesystem>

#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

constexpr const char* kCoarse =
    "--no-report --set physics.accuracy=0.4 --set duration=10 --set cpg.frequency=0.45 "
    "--set actuator.load_friction=0 --set actuator.dry_friction=0 --set actuator.viscous_friction=0 "
    "--set actuator.rotor_inertia=0 --out ";

class Retry : public ::testing::Test {
 protected:
  [[nodiscard]] Result run(const std::string& options) const {
    return gaitlab("run " + kScenarios + "library/y1-pp.yaml " + kCoarse + options, folder / "");
  }
  [[nodiscard]] std::string text(const std::string& file) const { return read(folder / file); }
  Folder folder;
};

TEST_F(Retry, TheFolderHoldsTheSecondRunAlone) {
  const Result twice = run("a");
  EXPECT_EQ(twice.code, 0) << twice.err;
  EXPECT_TRUE(contains(twice.err, "note: not judged: the torque of joint ")) << twice.err;
  EXPECT_TRUE(contains(twice.err, "; simulated again with physics.accuracy=0.0")) << twice.err;
  EXPECT_TRUE(contains(twice.err, "(--no-retry keeps the first run)")) << twice.err;
  EXPECT_TRUE(contains(twice.out, "verdict   feasible")) << twice.out;
  EXPECT_FALSE(contains(text("a/scenario.resolved.yaml"), "accuracy: 0.4"));
  const Result verified = gaitlab("rerun --verify a", folder / "");
  EXPECT_EQ(verified.code, 0) << verified.err;
  EXPECT_TRUE(contains(verified.out, "bit-equal")) << verified.out;
}

TEST_F(Retry, TheFirstRunStaysIfAskedFor) {
  const Result once = run("a --no-retry");
  EXPECT_TRUE(contains(once.out, "verdict   not judged: ")) << once.out;
  EXPECT_FALSE(contains(once.err, "simulated again")) << once.err;
  EXPECT_TRUE(contains(text("a/scenario.resolved.yaml"), "accuracy: 0.4"));
  const std::string at = "  judge by  gaitlab run ";
  const std::size_t line = once.out.find(at);
  ASSERT_NE(line, std::string::npos) << once.out;
  const std::string command = once.out.substr(line + at.size() - 4, once.out.find('\n', line) - line - at.size() + 4);
  EXPECT_FALSE(contains(command, "accuracy=0.4")) << command;
  EXPECT_TRUE(contains(command, "--set duration=10 --set cpg.frequency=0.45 ")) << command;
  const Result copied = gaitlab(command + " --no-report", folder / "");
  EXPECT_TRUE(contains(copied.out, "verdict   feasible")) << copied.out << copied.err;
}

TEST_F(Retry, ADurationIsNotChanged) {
  const Result shorter = run("a --set duration=3");
  EXPECT_TRUE(contains(shorter.out, "; and 2 s after 1 s")) << shorter.out;
  EXPECT_TRUE(contains(shorter.out, " --set duration=7.667\n")) << shorter.out;
  EXPECT_FALSE(contains(shorter.err, "simulated again")) << shorter.err;
}

}  // namespace
}  // namespace gaitlab::test
