// Tests of the torque error of the points of `gaitlab sweep`, and of notes on the error of a fixed step.
#include "tests/app/study_fixture.h"
#include "tests/labels.h"

namespace gaitlab::test {
namespace {

const Label kLongSweepEstimate("SweepEstimate.EstimatesSomePoints:SweepEstimate.IsOfAllPointsWhereSomeAreNotToBeTrusted",
                               "long");

class SweepEstimate : public StudyFixture {};

/// The torque error of some points is estimated; the selection does not depend on lanes or threads. All other points count as
/// equally accurate, and the output states this.
TEST_F(SweepEstimate, EstimatesSomePoints) {
  const auto swept = [&](const char* every, const char* out, const char* how) {
    folder_.write("study.yaml", "gaitlab_study: 1\nscenario: " + kScenarios +
                                    "caterpillar.yaml\nset: [physics.engine=articulated, duration=12]\n" + every +
                                    "parameters: {cpg.amplitude: {low: 0.2, high: 0.34, count: 8}}\n");
    Result made = call(fmt::format("sweep study.yaml --out {} {}", out, how));
    EXPECT_EQ(made.code, 0) << made.err;
    return made;
  };
  const auto estimated = [&](const char* out) {
    std::string runs;
    for (const auto& row : table(out)) {
      EXPECT_EQ(row.at("verdict"), "feasible") << row.at("message");
      if (!row.at("torque_error.worst").empty()) runs += row.at("run") + " ";
    }
    return runs;
  };
  const Result all = swept("estimate_every: 1\n", "all", "");
  EXPECT_EQ(estimated("all"), "0 1 2 3 4 5 6 7 ");
  EXPECT_TRUE(contains(all.out, "torque error estimated in 8 runs: 1 beyond 1 %, 0 beyond 5 %; at most 1.3 %")) << all.out;
  EXPECT_EQ(all.err.find("own gait"), std::string::npos) << "its torque error is below 1 %: " << all.err;
  swept("estimate_every: 2\n", "some", "-j 1 --lanes 1 --quiet");
  const std::string some = estimated("some");
  EXPECT_GE(some.size(), 2 * 3U) << some;  // enough points as evidence for the others
  EXPECT_LT(some.size(), 2 * 8U);
  swept("estimate_every: 2\n", "again", "-j 2 --lanes 4 --quiet");
  EXPECT_EQ(estimated("again"), some);
  swept("estimate_every: 100\n", "few", "--quiet");
  EXPECT_EQ(estimated("few"), "0 1 2 3 4 5 6 7 ") << "fewer than 3 are no evidence";
  const Result none = swept("estimate_every: 0\n", "none", "");
  EXPECT_EQ(estimated("none"), "");
  EXPECT_TRUE(contains(none.out, "torque error estimated in none of the runs: nothing shows how accurate `feasible` is"))
      << none.out;
  const Result rerun = call("study rerun none 3");
  EXPECT_EQ(rerun.code, 0) << rerun.err;
  EXPECT_TRUE(contains(rerun.out, "the quantities are equal to those in the journal")) << rerun.out;
}

/// Before the first run, a note states the error of the speed that a step of 2.5 ms causes for the caterpillar in engine
/// articulated.
TEST_F(SweepEstimate, TellsWhatTheStepCosts) {
  const Result swept =
      call("sweep " + kScenarios +
           "caterpillar.yaml --set physics.engine=articulated --set physics.step=0.0025 --set duration=6 --grid "
           "cpg.amplitude=0.3 --out s");
  EXPECT_EQ(swept.code, 0) << swept.err;
  EXPECT_TRUE(contains(swept.err, "note: step 0.0025 s causes an error of ")) << swept.err;
  EXPECT_TRUE(contains(swept.err, " in speed for the scenario's own gait, auto ")) << swept.err;
  EXPECT_TRUE(contains(swept.err, ": take physics.step: auto")) << swept.err;
}

/// If some estimated points are inaccurate, all points are estimated. Steps of 5 ms are too long for a gait of 0.8 Hz and cause
/// an error of a tenth.
TEST_F(SweepEstimate, IsOfAllPointsWhereSomeAreNotToBeTrusted) {
  const auto swept = [&](const char* every, const char* out, const char* how) {
    folder_.write("study.yaml",
                  "gaitlab_study: 1\nscenario: " + kScenarios +
                      "caterpillar.yaml\nset: [physics.engine=articulated, physics.integrator=implicit, physics.step=0.005, "
                      "cpg.frequency=0.8, duration=12]\n" +
                      every + "parameters: {cpg.amplitude: {low: 0.2, high: 0.34, count: 8}}\n");
    Result made = call(fmt::format("sweep study.yaml --out {} {}", out, how));
    EXPECT_EQ(made.code, 0) << made.err;
    return made;
  };
  const Result all = swept("estimate_every: 1\n", "all", "");
  EXPECT_TRUE(contains(all.out, "more than one in ten errors is beyond 5 %: take physics.step: auto")) << all.out;
  EXPECT_EQ(all.err.find("again with an estimate"), std::string::npos) << all.err;
  const Result some = swept("seed: 2\nestimate_every: 3\n", "some", "-j 1 --lanes 1");
  EXPECT_TRUE(contains(some.err, "more than one of ten estimated runs: the other 3 runs are made again with an estimate"))
      << some.err;
  EXPECT_EQ(table("some"), table("all"));
  const Result again = swept("seed: 2\nestimate_every: 3\n", "some", "");
  EXPECT_EQ(again.err.find("again with an estimate"), std::string::npos) << "nothing is left: " << again.err;
  swept("seed: 2\nestimate_every: 3\n", "lanes", "-j 2 --lanes 4 --quiet");
  EXPECT_EQ(table("lanes"), table("all"));
}

}  // namespace
}  // namespace gaitlab::test
