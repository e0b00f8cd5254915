// Tests of the demand: the second run with 20 times the motor limits.
#include "report/verdict/demand.h"

#include "report/analysis/fall.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongDemand("Demand.SaysWhatMakesItDoubtful", "long");

using namespace report;

std::vector<std::string> four_seconds(std::vector<std::string> sets) {
  sets.insert(sets.end(), {"duration=4", "physics.engine=articulated"});
  return sets;
}

/// Run of a caterpillar whose current limit is too low, and its demand.
struct Weak {
  Scenario scenario = shipped("caterpillar.yaml", four_seconds({"actuator.i_max=0.35"}));
  Recording record = run(scenario);
  Summary summary = summarise(scenario, record, 0);
  Verdict judged = verdict(scenario, record, summary, overlaps(scenario, record));
};

TEST(Demand, IsTheRunWithLimitsTwentyTimesAsLarge) {
  Weak weak;
  Scenario twin = shipped("caterpillar.yaml", four_seconds({"actuator.i_max=0.35"}));
  ASSERT_TRUE(raise_limits(twin));
  const Demand made = demand(twin, weak.record, weak.summary);
  ASSERT_TRUE(made.known);
  EXPECT_EQ(made.doubt, "");
  // The demand equals the peaks of a separate run with 20 times the limits.
  const Scenario free = shipped("caterpillar.yaml", four_seconds({"actuator.i_max=7", "actuator.u_max=148"}));
  const Recording record = run(free);
  const std::vector<JudgedJoint> joints =
      judge(record, weak.summary.limit_cycle, weak.summary.gait.period, weak.summary.gait.start).joints;
  ASSERT_EQ(made.joints.size(), joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    EXPECT_EQ(made.joints[j].torque_peak, joints[j].torque_peak) << j;
    EXPECT_EQ(made.joints[j].current_peak, joints[j].current_peak) << j;
    EXPECT_EQ(made.joints[j].voltage_peak, joints[j].voltage_peak) << j;
    // By eq. 2, T = eta Kt n i, so that both peaks are at the same time and their ratio is exact up to rounding.
    EXPECT_NEAR(joints[j].torque_peak, 0.7 * 0.00395 * 594 * joints[j].current_peak, 1e-12);
  }
  ASSERT_GT(weak.judged.count(CheckStatus::fail), 0U);
  add_demand(weak.judged, weak.scenario, weak.summary, made);
  // The demand contains every joint that reaches its limit at any time. The missing amount is that of the joint that lacks
  // most.
  const std::vector<JudgedJoint>& own = weak.summary.judged.joints;
  std::size_t limited = 0;
  double most = 0;
  for (std::size_t j = 0; j < own.size(); ++j) {
    if (!(own[j].current_limited > 0)) continue;
    ++limited;
    most = std::max(most, joints[j].current_peak - 0.35);
  }
  EXPECT_EQ(weak.judged.demands.size(), limited);
  const auto current = std::ranges::find(weak.judged.checks, "current", &Check::id);
  EXPECT_EQ(current->status, CheckStatus::fail);
  EXPECT_EQ(current->parts, limited);
  EXPECT_EQ(current->missing.substr(0, current->missing.find(" at ")), fmt::format("{:.3g} A", most));
  EXPECT_TRUE(contains(to_json(weak.judged), "\"demand\": {"));
}

/// For an actuator without limits no second run is simulated and no demand is reported.
TEST(Demand, OfAnActuatorWithoutLimitsIsNotKnown) {
  Scenario held = shipped("pendulum.yaml");
  EXPECT_FALSE(raise_limits(held));
}

/// The program states the cause of a doubtful demand. At 5 Hz the strong motors throw the robot into the air. With 5 mA, 20
/// times the limit is also too small. A CPG that diverges ends the run. (A demand without doubt:
/// IsTheRunWithLimitsTwentyTimesAsLarge.)
TEST(Demand, SaysWhatMakesItDoubtful) {
  const Weak weak;
  const auto twin = [](std::vector<std::string> sets) {
    Scenario made = shipped("caterpillar.yaml", four_seconds(std::move(sets)));
    EXPECT_TRUE(raise_limits(made));
    return made;
  };
  const std::vector<std::string> fast{"actuator.i_max=0.35", "cpg.frequency=5"};
  const Scenario hurried = shipped("caterpillar.yaml", four_seconds(fast));
  const Recording own = run(hurried);
  const Demand thrown = demand(twin(fast), own, summarise(hurried, own, 0));
  EXPECT_TRUE(thrown.known);
  EXPECT_EQ(thrown.doubt, "without motor limits the robot is thrown up, so that these torques do not belong to the gait");
  const Demand limited = demand(twin({"actuator.i_max=0.005"}), weak.record, weak.summary);
  EXPECT_TRUE(limited.known);
  EXPECT_EQ(limited.doubt, "the gait reaches the motor limits even if they are 20 times as large: it needs more than that");
  const Scenario wild = scenario(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.2\n"
      "cpg: {type: equations, model: {states: {phi: exp(700)*exp(700)}, output: phi}}\n");
  const Demand broken = demand(wild, weak.record, weak.summary);
  EXPECT_FALSE(broken.known);
  EXPECT_TRUE(broken.doubt.starts_with("without motor limits the run breaks off: ")) << broken.doubt;
}

/// A robot on the ground that leaps makes the demand doubtful. The height of a robot with a fixed base does not.
TEST(Demand, KnowsALeap) {
  const Weak weak;
  const double start = heights(weak.scenario, weak.record).front();
  const auto doubt = [&](const Scenario& own, double rise) {
    Recording low = weak.record;
    const std::size_t columns = low.poses.columns.size();
    for (std::size_t row = 1; row < low.poses.rows(); ++row)
      std::copy_n(low.poses.values.begin(), columns, low.poses.values.begin() + static_cast<std::ptrdiff_t>(row * columns));
    Recording free = low;
    for (std::size_t row = 10; row < free.poses.rows(); ++row)
      free.poses.values[row * columns + free.poses.find("base.z")] += rise;
    return thrown_up(own, free, low);
  };
  EXPECT_FALSE(doubt(weak.scenario, 0.49 * start));
  EXPECT_TRUE(doubt(weak.scenario, 0.51 * start));
  Scenario fixed = weak.scenario;
  fixed.base = Base::fixed;
  EXPECT_FALSE(doubt(fixed, 0.51 * start));
}

/// `gaitlab report` repeats the demand that `run --demand` stored, if the stored file belongs to the recording.
TEST(Demand, StaysWithItsFolder) {
  const Folder folder;
  const std::string file = kScenarios + "caterpillar.yaml --set physics.engine=articulated --set duration=4 ";
  ASSERT_EQ(gaitlab("run " + file + "--set actuator.i_max=0.35 --demand --out a", folder.path()).code, 0);
  const std::string told = read(folder / "a/verdict.json");
  ASSERT_TRUE(contains(told, "\"demand\": {")) << told;
  const Result again = gaitlab("report a --out b", folder.path());
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(read(folder / "b/verdict.json") == told);
  EXPECT_TRUE(read(folder / "b/report.html") == read(folder / "a/report.html"));
  EXPECT_TRUE(contains(again.out, "missing: ")) << again.out;
  // A file of a different run, a damaged file and a missing file are not used.
  ASSERT_EQ(gaitlab("run " + file + "--set actuator.i_max=0.3 --demand --no-report --out other", folder.path()).code, 0);
  const std::string note = "a/verdict.json: note: belongs to another recording; its results of second runs are not shown\n";
  for (const std::string& text :
       {read(folder / "other/verdict.json"), std::string("{\"demand\": 3}"), std::string("garbage")}) {
    folder.write("a/verdict.json", text);
    const Result without = gaitlab("report a", folder.path());
    EXPECT_EQ(without.code, 0);
    EXPECT_TRUE(contains(without.err, note)) << without.err;
    EXPECT_FALSE(contains(without.out, "missing: ")) << without.out;
  }
  std::filesystem::remove(folder / "a/verdict.json");
  EXPECT_EQ(gaitlab("report a", folder.path()).code, 0);
}

TEST(Demand, OfALimitOfNothingIsNotKnown) {
  Scenario none = shipped("caterpillar.yaml", four_seconds({"actuator.u_max=0"}));
  EXPECT_FALSE(raise_limits(none));
}

}  // namespace
}  // namespace gaitlab::test
