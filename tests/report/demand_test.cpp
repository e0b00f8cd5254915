// The demand twin: what motors without limits would take.
#include "report/demand.h"

#include "report/fall.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

std::vector<std::string> with(std::vector<std::string> sets) {
  sets.insert(sets.end(), {"duration=4", "physics.engine=articulated"});
  return sets;
}

/// A caterpillar whose motors have too little current, and what it takes.
struct Weak {
  Scenario scenario = shipped("caterpillar.yaml", with({"actuator.i_max=0.35"}));
  Recording record = run(scenario);
  Summary summary = summarise(scenario, record, 0);
  Verdict judged = verdict(scenario, record, summary, overlaps(scenario, record));
};

TEST(Demand, IsTheRunWithLimitsTwentyTimesAsLarge) {
  Weak weak;
  Scenario twin = shipped("caterpillar.yaml", with({"actuator.i_max=0.35"}));
  ASSERT_TRUE(raise_limits(twin));
  const Demand made = demand(twin, weak.record, weak.summary);
  ASSERT_TRUE(made.known);
  EXPECT_EQ(made.doubt, "");
  // The same by the command line, in a run of its own.
  const Scenario free = shipped("caterpillar.yaml", with({"actuator.i_max=7", "actuator.u_max=148"}));
  const Recording record = run(free);
  const std::vector<JudgedJoint> joints = judge(record, weak.summary.limit_cycle).joints;
  ASSERT_EQ(made.joints.size(), joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    EXPECT_EQ(made.joints[j].torque_peak, joints[j].torque_peak) << j;
    EXPECT_EQ(made.joints[j].current_peak, joints[j].current_peak) << j;
    EXPECT_EQ(made.joints[j].voltage_peak, joints[j].voltage_peak) << j;
    // eq. 2: T = eta Kt n i, so that the peaks are of one instant; to rounding.
    EXPECT_NEAR(joints[j].torque_peak, 0.7 * 0.00395 * 594 * joints[j].current_peak, 1e-12);
  }
  ASSERT_EQ(weak.judged.word, "infeasible");
  add_demand(weak.judged, weak.scenario, weak.summary, made);
  // Every joint that is at its limit for some time; what is missing is of the one that lacks most.
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
  EXPECT_EQ(current->joints, limited);
  EXPECT_EQ(current->missing.substr(0, current->missing.find(" at ")), fmt::format("{:.3g} A", most));
  EXPECT_TRUE(contains(to_lines(weak.judged).front() + to_lines(weak.judged).at(1) + to_lines(weak.judged).at(2), "missing"));
  EXPECT_TRUE(contains(to_json(weak.judged), "\"demand\": {"));
}

/// Nothing is missing where no limit is reached: nothing is asked.
TEST(Demand, OfAnActuatorWithoutLimitsIsNotKnown) {
  Scenario held = shipped("pendulum.yaml");
  EXPECT_FALSE(raise_limits(held));
}

/// A twin at 20 Hz needs more than twenty times the current, or breaks off: it is never told as if it were known.
TEST(Demand, SaysWhatMakesItDoubtful) {
  const Weak weak;
  Scenario twin = shipped("caterpillar.yaml", with({"actuator.i_max=0.35", "cpg.frequency=20"}));
  raise_limits(twin);
  const Demand wild = demand(twin, weak.record, weak.summary);
  EXPECT_NE(wild.doubt, "");
}

/// The height of the place where it hangs is nothing to a robot with a fixed base; on the ground a leap is one.
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

TEST(Demand, OfALimitOfNothingIsNotKnown) {
  Scenario none = shipped("caterpillar.yaml", with({"actuator.u_max=0"}));
  EXPECT_FALSE(raise_limits(none));
}

}  // namespace
}  // namespace gaitlab::test
