// Verdict, window and demand of runs with changes and faults (section `at`).
#include <algorithm>

#include "core/scenario/change_section.h"
#include "report/analysis/changes.h"
#include "report/analysis/fall.h"
#include "report/verdict/demand.h"
#include "report/verdict/screen.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

/// A run of the caterpillar (period 4 s) with its verdict.
struct JudgedRun {
  explicit JudgedRun(std::vector<std::string> sets)
      : scenario(shipped("caterpillar.yaml", with_engine(std::move(sets)))),
        record(run(scenario)),
        summary(summarise(scenario, record, 0)),
        judged(verdict(scenario, record, summary, overlaps(scenario, record))) {}
  static std::vector<std::string> with_engine(std::vector<std::string> sets) {
    sets.emplace_back("physics.engine=articulated");
    return sets;
  }
  [[nodiscard]] const Check& check(const std::string& id) const { return *std::ranges::find(judged.checks, id, &Check::id); }
  [[nodiscard]] bool worst_anywhere(const std::string& joint) const {
    return std::ranges::any_of(judged.checks, [&](const Check& c) { return c.group == CheckGroup::motor && c.worst == joint; });
  }

  Scenario scenario;
  Recording record;
  Summary summary;
  Verdict judged;
};

TEST(FaultVerdict, LeavesOutTheFaultyJointAndNamesIt) {
  const JudgedRun dead({"duration=26", "at=[{t: 10, fault: {joint: m3/active, kind: dead}}]"});
  EXPECT_EQ(dead.judged.word, Word::feasible) << dead.judged.why();
  EXPECT_EQ(dead.judged.faults, std::vector<std::string>{"m3/active: not judged (dead from t = 10 s)"});
  EXPECT_GE(dead.summary.judged.from, 10);
  EXPECT_GE(dead.summary.limit_cycle.from, 10);
  EXPECT_FALSE(dead.worst_anywhere("m3/active"));
  EXPECT_EQ(dead.check("tracking").status, CheckStatus::pass) << "the dead joint is farther from its set point than is allowed";
  EXPECT_GT(dead.record.joints[6].error_peak, dead.scenario.limits.tracking_error);
  EXPECT_NE(to_json(dead.judged).find("\"faults\": [\n    \"m3/active: not judged (dead from t = 10 s)\"\n  ]"),
            std::string::npos);
  std::string screen;
  for (const ScreenLine& line : first_screen({dead.scenario, dead.record, dead.summary}, dead.judged, 9)) {
    screen += line.title + "|" + line.text + "\n";
  }
  EXPECT_NE(screen.find("changes|10 s: m3/active dead\n|m3/active: not judged (dead from t = 10 s)\n"), std::string::npos)
      << screen;
}

TEST(FaultVerdict, TheOtherJointsDecide) {
  const JudgedRun stuck({"duration=26", "at=[{t: 10, fault: {joint: m3/active, kind: stuck}}]"});
  EXPECT_EQ(stuck.judged.word, Word::infeasible);
  EXPECT_EQ(stuck.judged.decided_by, "current");
  EXPECT_FALSE(stuck.worst_anywhere("m3/active"));
}

TEST(FaultVerdict, NeedsThreePeriodsAfterTheLastChange) {
  const JudgedRun short_run({"duration=18", "at=[{t: 10, fault: {joint: m3/active, kind: dead}}]"});
  EXPECT_EQ(short_run.judged.word, Word::not_judged);
  EXPECT_EQ(short_run.judged.reason.text,
            "8 s after 10 s contain only 2 of the 3 periods of 4 s that a gait needs; take duration: 22");
  const JudgedRun changed({"duration=18", "at=[{t: 10, set: {cpg.frequency: 0.5}}]"});
  EXPECT_EQ(changed.judged.word, Word::feasible) << changed.judged.why();
  EXPECT_NEAR(changed.summary.limit_cycle.period, 2, 0.01);
  EXPECT_TRUE(changed.judged.faults.empty());
}

TEST(FaultVerdict, AFaultThatEndsIsPartOfWholeRunChecksOnly) {
  const JudgedRun ended({"duration=26",
                         "at=[{t: 4, fault: {joint: m3/active, kind: weak, share: 0.3}}, "
                         "{t: 8, fault: {joint: m3/active, kind: none}}]"});
  EXPECT_EQ(ended.judged.word, Word::feasible) << ended.judged.why();
  EXPECT_EQ(ended.judged.faults,
            std::vector<std::string>{"m3/active: not judged by checks of the whole run (weak from t = 4.005 s to 8.01 s)"});
  EXPECT_GE(ended.summary.judged.from, 8);
}

TEST(FaultVerdict, WithoutAnyHealthyJointMotorsAreNotJudged) {
  const JudgedRun all({"duration=12", "at=[{t: 0, fault: {joint: '*', kind: dead}}]"});
  EXPECT_EQ(all.check("voltage").status, CheckStatus::not_judged);
  EXPECT_EQ(all.check("voltage").text, "every joint has a fault");
  EXPECT_EQ(all.check("heat").text, "every joint has a fault");
  EXPECT_EQ(all.check("tracking").text, "every joint has a fault");
  EXPECT_EQ(all.check("stops").text, "every joint has a fault");
  EXPECT_EQ(all.check("stops").status, CheckStatus::not_judged);
}

// Checks judge a joint whose fault is replaced within its change or has no effect.
TEST(FaultVerdict, WithoutEffectThereIsNoFault) {
  const Scenario s = shipped(
      "caterpillar.yaml", {"at=[{t: 4, fault: [{joint: '*', kind: weak, share: 0.5}, {joint: m3/active, kind: none}]}, "
                           "{t: 5, fault: [{joint: '*', kind: lost, share: 0}, {joint: m4/active, kind: weak, share: 1}]}]"});
  const std::vector<FaultSpan> spans = fault_spans(s);
  EXPECT_EQ(spans.size(), 15U);
  for (const FaultSpan& span : spans) {
    EXPECT_NE(s.robot->joints[span.joint].name, "m3/active");
    EXPECT_NEAR(span.from, 267 * 0.015, 1e-12);
    EXPECT_NEAR(span.to, 334 * 0.015, 1e-12);
  }
}

// A time between control ticks counts from the next tick, which may be the end of the run.
TEST(FaultVerdict, ChangesCountFromTheirTick) {
  const auto at = [](const std::string& t) {
    return shipped("caterpillar.yaml", {"duration=20", "at=[{t: " + t + ", fault: {joint: m3/active, kind: dead}}]"});
  };
  EXPECT_NEAR(last_change(at("10"), 20), 667 * 0.015, 1e-12);
  EXPECT_NEAR(last_change(at("0.015"), 20), 0.015, 1e-12);
  EXPECT_NE(message_of([&] {
              at("19.996");
            }).find("t is 19.996 s, and the change takes effect at the next control tick, 20.01 s, but the run ends at 20 s"),
            std::string::npos);
}

TEST(FaultVerdict, TheRunWithoutMotorLimitsHasTheFaults) {
  const std::vector<std::string> sets{
      "duration=4", "actuator.i_max=0.35",
      "at=[{t: 1, fault: [{joint: m3/active, kind: open}, {joint: m4/active, kind: weak, share: "
      "0.5}]}]"};
  const JudgedRun weak(sets);
  Scenario twin = shipped("caterpillar.yaml", JudgedRun::with_engine(sets));
  ASSERT_TRUE(raise_limits(twin));
  const Demand made = demand(twin, weak.record, weak.summary);
  std::vector<std::string> free = sets;
  free[1] = "actuator.i_max=7";
  free.emplace_back("actuator.u_max=148");
  const JudgedRun by_hand(free);
  const std::vector<JudgedJoint> joints =
      judge(by_hand.record, weak.summary.limit_cycle, weak.summary.gait.period, weak.summary.gait.start).joints;
  ASSERT_EQ(made.joints.size(), joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) EXPECT_EQ(made.joints[j].torque_peak, joints[j].torque_peak) << j;
  EXPECT_EQ(made.joints[6].torque_peak, 0);
}

// A weak motor at its current limit gives all of its available torque, which the fault reduces.
TEST(FaultVerdict, AvailableTorqueHasTheFault) {
  const JudgedRun weak({"duration=4", "at=[{t: 0, fault: {joint: m3/active, kind: weak, share: 0.1}}]"});
  const JudgedRun whole({"duration=4"});
  EXPECT_GT(weak.summary.judged.whole[6].envelope_peak, 2 * whole.summary.judged.whole[6].envelope_peak);
  EXPECT_LE(weak.summary.judged.whole[6].envelope_peak, 1);
}

TEST(Changes, InWords) {
  const Scenario s =
      shipped("caterpillar.yaml", {"at=[{t: 1, set: {cpg.amplitude: 0.4}, fault: {joint: [m0/active, 'm1/*'], kind: lost, "
                                   "share: 0.3}}, {t: 2, fault: {joint: m0/active, kind: late, delay: 0.03}}, "
                                   "{t: 3, fault: {joint: m0/active, kind: none}}]"});
  const std::vector<ToldChange> told = told_changes(s, 2.5);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].text, "cpg.amplitude 0.4, m0/active m1/* lost 30 %");
  EXPECT_EQ(told[1].text, "m0/active late 0.03 s");
  EXPECT_EQ(told_changes(s, 20)[2].text, "m0/active without fault");
}

}  // namespace
}  // namespace gaitlab::test
