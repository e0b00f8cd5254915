// Tests of `gaitlab test` for scenarios with `measured.bound`, with and without a golden.
#include "tests/program/fixture.h"
#include "tests/program/rod.h"

namespace gaitlab::test {
namespace {

/// A bench whose log, an arm at rest, is 0.1 s long and differs from the run by at most 28 mrad.
class Bound : public ::testing::Test {
 protected:
  Bound() { folder.write("log.csv", "t,angle\n0,0\n0.05,0\n0.1,0\n"); }
  void write(const std::string& bound) {
    folder.write("bench.yaml",
                 rod() +
                     "ground: {type: none}\ncontact: {on: none}\nphysics: {engine: articulated, estimate: off}\n"
                     "actuator: {type: servo, voltage: 6, stall_torque: 8, no_load_speed: 6, stall_current: 12}\n"
                     "controller: {type: rc_servo, gain: 4, period: 0.01}\ncpg: {type: sine, frequency: 1, amplitude: 0.6}\n"
                     "duration: 0.1\nmeasured: {file: log.csv, columns: {m0/swing: {angle: angle}}" +
                     bound + "}\n");
  }
  Result test(const std::string& more = {}) { return gaitlab("test bench.yaml" + more, folder / ""); }
  Folder folder;
};

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "not in:\n" << text;
}

TEST_F(Bound, NeedsNoGolden) {
  write(", bound: {angle.mae: 0.1, angle.peak: 0.2}");
  const Result good = test();
  EXPECT_EQ(good.code, 0) << good.err;
  expect_contains(good.out, "  measured.angle.peak  ");
  expect_contains(good.out, "1 passed, 0 failed\n");
  write(", bound: {angle.mae: 0.001, angle.peak: 0.2}");
  const Result bad = test(" --junit result.xml");
  EXPECT_EQ(bad.code, 4);
  expect_contains(bad.out, "bench.yaml: 1 of 2 bounds exceeded\n  measured.angle.mae is 0.0");
  expect_contains(bad.out, " rad, its bound 0.001 rad (log 'log.csv')\n\n0 passed, 1 failed\n");
  expect_contains(read(folder / "result.xml"), "<failure message=\"1 of 2 bounds exceeded\">");
  write("");
  expect_contains(test().err, "has no golden");
}

TEST_F(Bound, IsJudgedBesideAGolden) {
  write(", bound: {angle.mae: 0.001}");
  ASSERT_EQ(gaitlab("approve bench.yaml --reason 'the bench'", folder / "").code, 0);
  const Result bad = test();
  EXPECT_EQ(bad.code, 4);
  expect_contains(bad.out, "numbers outside their bands, 1 of 1 bound exceeded\nsince approval 1 (the bench):\n");
  expect_contains(bad.out, " rad, its bound 0.001 rad (log 'log.csv')\n");
}

TEST_F(Bound, FailsIfTheRunEndsBeforeTheLog) {
  folder.write("log.csv", "t,angle\n0,0\n0.5,0\n");
  write(", bound: {angle.mae: 1}");
  const Result bad = test();
  EXPECT_EQ(bad.code, 4);
  expect_contains(bad.out, "measured.angle.mae is not known: the run covers fewer than two rows of log 'log.csv'\n");
}

}  // namespace
}  // namespace gaitlab::test
