// Robots and grounds that are far too large are refused quickly, with little memory, and without a signal.
#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

class LargeRobot : public ::testing::Test {
 protected:
  LargeRobot() { std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules"); }

  void chain(int modules, const std::string& more) {
    std::string docks;
    for (int m = 1; m < modules; ++m) docks += fmt::format("{}[1, {}, 4, {}, 0]", m == 1 ? "" : ", ", m, m - 1);
    folder_.write("s.yaml", "gaitlab: 1\nrobot: {modules: mtran, docks: [" + docks + "]}\n" + more + "duration: 0.1\n");
  }
  /// Result of `check` of s.yaml within limits of ulimit (-v is memory in kB, -t is CPU time in s).
  Result check(const std::string& limits) {
    const std::string command = fmt::format("cd '{}' && ulimit {}; '{}/bin/gaitlab' check s.yaml 2>err >out",
                                            folder_.path().string(), limits, gaitlab::test::build_folder());
    const int status = std::system(("bash -c \"" + command + "\"").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder_ / "out"), read(folder_ / "err")};
  }
  /// True if the program starts within the limits. With a sanitizer it does not, because a sanitizer reserves more memory.
  bool has_room(const std::string& limits) {
    chain(2, "");
    return check(limits).code == 0;
  }

  Folder folder_;
};

// A robot of 20 000 modules is refused quickly. (It once needed 13 GB and 51 s, and ended by SIGSEGV with 4 GB.)
TEST_F(LargeRobot, OfTwentyThousandModulesIsRefusedBeforeItCosts) {
  const std::string limits = "-t 20 -v 500000";
  if (!has_room(limits)) GTEST_SKIP() << "a sanitizer, which reserves more than any limit";
  chain(20'000, "physics: {engine: articulated}\n");
  const Result result = check(limits);
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "s.yaml:2:8: error: the robot has 60000 bodies; expected at most 40000, which take 2 GB of memory\n");
  chain(6'000, "");
  EXPECT_EQ(
      check(limits).err,
      "s.yaml: error: engine bullet keeps a number for every pair of joints, 1.15 GB for the 12000 joints here, and takes at "
      "most 10000 joints; use engine: articulated, whose memory grows with the number of joints\n");
  chain(1'001, "physics: {engine: bullet, integrator: semi_implicit}\nactuator: {rotor_inertia: 1e-7}\n");
  EXPECT_EQ(
      check(limits).err,
      "s.yaml:3:19: error: engine bullet with an explicit integrator solves for all 2002 joints at once in every step, because "
      "actuator.rotor_inertia is not 0, and takes at most 2000 joints then; use integrator: adaptive, whose time grows with "
      "the number of joints\n");
}

// Without memory for Bullet the program ends with a message. (Bullet once wrote to a null pointer after a failed allocation.)
TEST_F(LargeRobot, WithoutMemoryForBulletEndsWithAWord) {
  if (!has_room("-v 120000")) GTEST_SKIP() << "a sanitizer, which reserves more than any limit";
  chain(3'000, "");  // needs 288 MB for the pairs of its joints
  for (const int kilobytes : {150'000, 250'000, 350'000}) {
    const Result result = check(fmt::format("-v {}", kilobytes));
    EXPECT_EQ(result.code, 1) << kilobytes;
    EXPECT_EQ(result.err, "gaitlab: error: out of memory\n") << kilobytes;
  }
}

// A robot on 20 000 boxes at one place is accepted quickly. (The search for the way out of n boxes once examined n^4 boxes, so
// that the first step did not end.)
TEST_F(LargeRobot, OnTwentyThousandBoxesInOnePlaceIsRefused) {
  if (!has_room("-v 2000000")) GTEST_SKIP() << "a sanitizer, which takes a hundred times as long";
  std::string boxes;
  for (int b = 0; b < 20'000; ++b) {
    boxes += std::string(b == 0 ? "" : ", ") + "{center: [0, 0, 0.05], size: [0.4, 0.4, 0.1]}";
  }
  folder_.write("s.yaml",
                "gaitlab: 1\nrobot: {modules: mtran}\nduration: 0.1\nground: {type: boxes, boxes: [" + boxes + "]}\n");
  const Result result = check("-t 100");  // takes 0.3 s
  EXPECT_EQ(result.code, 2) << result.err;
  EXPECT_TRUE(contains(result.err, "s.yaml:4:31: error: more than 100 boxes contain the centre of boxes[0], [0, 0, 0.05]; "))
      << result.err;
}

}  // namespace
}  // namespace gaitlab::test
