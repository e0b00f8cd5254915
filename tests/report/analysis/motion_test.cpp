// The verdict uses the motion at control ticks, so that it does not depend on the rows of the trace.
#include "report/analysis/motion.h"

#include <nlohmann/json.hpp>

#include "core/recording/recording_file.h"
#include "core/scenario/resolved.h"
#include "report/analysis/states.h"
#include "report/verdict/numbers/numbers.h"
#include "report/verdict/numbers/summary_text.h"
#include "report/verdict/verdict.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongMotion("*AnyRows.GiveTheSameNumbersAndVerdict/*", "long");

using namespace report;
using Json = nlohmann::ordered_json;

/// Scenario of a robot with four legs and a spine of three modules, with a gait of 1 Hz.
constexpr const char* kQuadruped =
    "gaitlab: 1\nname: quadruped\n"
    "robot: {modules: mtran, docks: [[1, 1, 4, 0, 1], [1, 2, 4, 1, 3], [0, 3, 3, 0, 3], [2, 4, 5, 0, 1], [0, 5, 3, 2, 3], "
    "[2, 6, 5, 2, 1]]}\n"
    "cpg: {type: tripod, frequency: 1, amplitude: 0.3}\nphysics: {engine: articulated}\nduration: 3\n";

/// Text of the verdict and of all summary numbers, except computing times and the hash of the rows.
std::string all_numbers(const Scenario& s, const Recording& r) {
  const Summary summary = summarise(s, r, 1);
  Json json = Json::parse(to_json(summary, s, r));
  for (const char* const of_rows : {"trace_hash", "columns"}) json.erase(of_rows);
  const Posture& p = summary.posture;
  return json.dump(1) +
         fmt::format("\nborne {} airborne {} cycle speed {} set points {}\n", p.borne_share, p.airborne_share,
                     cycle_speed(r, summary.judged), set_point_cycle(s, r).period) +
         to_json(verdict(s, r, summary, overlaps(s, r)));
}

std::vector<std::string> with_rows(std::vector<std::string> sets, const char* period) {
  sets.push_back(std::string("trace.period=") + period);
  return sets;
}

/// The judged window does not depend on the period of the rows. (From rows every 50 ms, the program once found no limit cycle,
/// and a window from 0.6 to 3 s.)
TEST(Motion, OfSparseRowsHasTheWindowOfFineOnes) {
  for (const char* period : {"0.001", "0.05"}) {
    const Scenario s = scenario(kQuadruped, with_rows({}, period));
    const Summary summary = summarise(s, run(s), 1);
    EXPECT_TRUE(summary.limit_cycle.found) << period;
    EXPECT_NEAR(summary.judged.from, 2, 1e-3) << period;  // tolerance for the estimate of the period
    EXPECT_EQ(summary.judged.to, 3) << period;
    EXPECT_EQ(summary.judged.periods, 1U) << period;
  }
}

struct Walker {
  const char *name, *scenario;
  std::vector<std::string> sets;
  bool settles;  ///< true if the gait settles within the run; runs in engine bullet are short
};

class AnyRows : public testing::TestWithParam<Walker> {};

TEST_P(AnyRows, GiveTheSameNumbersAndVerdict) {
  std::string first;
  for (const char* period : {"0.001", "0.005", "0.05"}) {
    const Scenario s = shipped(GetParam().scenario, with_rows(GetParam().sets, period));
    const Recording r = run(s);
    const std::string all = all_numbers(s, r);
    if (first.empty()) first = all;
    EXPECT_EQ(all, first) << period;
    EXPECT_EQ(summarise(s, r, 1).limit_cycle.found, GetParam().settles) << period;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Walks, AnyRows,
    testing::Values(
        Walker{"caterpillar", "caterpillar.yaml", {"duration=12", "physics.engine=articulated", "actuator.i_max=0.35"}, true},
        Walker{"hexapod", "hexapod.yaml", {"duration=7", "physics.engine=articulated"}, true},
        Walker{"spider", "library/revolve-spider.yaml", {"duration=8"}, true},
        Walker{"bullet_caterpillar", "caterpillar.yaml", {"duration=0.6", "cpg.frequency=2", "physics.engine=bullet"}, false},
        Walker{"bullet_hexapod", "hexapod.yaml", {"duration=0.6", "cpg.frequency=2", "physics.engine=bullet"}, false}),
    [](const auto& info) { return std::string(info.param.name); });

/// The quantities of stop rules during a run do not depend on the rows.
TEST(Motion, SoFarIsTheSameForAnyRows) {
  std::string first;
  for (const char* period : {"0.001", "0.05", "0.7"}) {
    const Scenario s = scenario(kQuadruped, with_rows({}, period));
    std::string all;
    Simulation simulation({&s, 1});
    simulation.watch([&](std::size_t, const Recording& so_far) {
      const Summary way = travelled(so_far);
      all += fmt::format("{} {} {} {}\n", way.simulated, way.distance, way.path_length, way.heading_change);
      return std::string();
    });
    simulation.run();
    if (first.empty()) first = all;
    EXPECT_EQ(all, first) << period;
  }
  EXPECT_TRUE(contains(first, "\n2"));
}

/// The limit cycle is found with unusual control periods, with an end within a step, and with merged ticks. Ticks are
/// equidistant except for the last tick.
TEST(Motion, FindsTheCycleOnAnyGrid) {
  const auto one = [](const char* control, const char* duration, const char* rest) {
    return scenario(
        fmt::format("gaitlab: 1\nname: arm\nduration: {}\nrobot: {{base: fixed, position: [0, 0, 1]}}\n"
                    "cpg: {{type: sine, frequency: 1.3, amplitude: 0.4}}\ncontroller: {{period: {}}}\n"
                    "physics: {{engine: articulated}}\nground: {{type: none}}\ntrace: {{period: 0.7}}\n{}",
                    duration, control, rest));
  };
  for (const auto& [control, duration] : {std::pair("0.0073", "5.00217"), {"0.0015", "5"}, {"0.031", "5.2"}, {"0.002", "45"}}) {
    const Scenario s = one(control, duration, "");
    const Recording r = run(s);
    const MotionCycle cycle = limit_cycle(s, r);
    EXPECT_TRUE(cycle.found) << control << ": " << cycle.error;
    EXPECT_NEAR(cycle.period, 1 / 1.3, 1e-4) << control;
    EXPECT_NEAR(set_point_cycle(s, r).period, 1 / 1.3, 1e-4) << control;
    const Series t = r.pose("t");
    ASSERT_EQ(t.size(), r.ticks.rows()) << control;
    for (std::size_t k = 1; k + 1 < t.size(); ++k) ASSERT_NEAR(t[k], static_cast<double>(k) * t[1], 1e-9) << control;
    EXPECT_EQ(t.back(), s.duration) << control;
  }
}

/// The values at a control tick equal those of a trace row at its time. The load is the sum of the loads of the modules.
TEST(Motion, AtTicksIsThatOfTheRows) {
  for (const char* engine : {"articulated", "bullet"}) {
    const Scenario s = shipped("hexapod.yaml", {"duration=0.6", "trace.period=0.015", "trace.columns=[\"*\"]",
                                                std::string("physics.engine=") + engine});
    const Recording r = run(s);
    ASSERT_EQ(s.control_period, 0.015);
    ASSERT_EQ(r.poses.rows(), r.rows()) << engine;
    for (const Column& column : r.poses.columns) {
      if (column.name == "load") continue;
      const Series at_ticks = r.pose(column.name);
      const Series rows = r.series(column.name);
      for (std::size_t k = 0; k < r.rows(); ++k) ASSERT_EQ(at_ticks[k], rows[k]) << engine << ", " << column.name << ", " << k;
    }
    double most = 0;
    for (std::size_t k = 0; k < r.rows(); ++k) {
      double load = 0;
      for (std::size_t m = 0; m < s.robot->modules.size(); ++m) {
        if (const Series one = r.series(fmt::format("load.{}", m)); !one.empty()) load += one[k];
      }
      ASSERT_NEAR(r.pose("load")[k], load, 1e-9 * (1 + load)) << engine;  // the sums have different orders of terms
      most = std::max(most, load);
    }
    EXPECT_GT(most, 0.5 * s.robot->mass * 9.81) << engine;
  }
}

TEST(Motion, HasTheCentreOfMassOfTheStates) {
  const Scenario s = shipped("hexapod.yaml", {"duration=0.6", "physics.engine=articulated"});
  const Recording r = run(s);
  const report::Motion recorded = report::motion(r);
  const States states = States::at_ticks(r, *s.robot);
  ASSERT_EQ(recorded.t.size(), states.size());
  Kinematics k(*s.robot);
  for (std::size_t row = 0; row < states.size(); ++row) {
    k.update(*s.robot, states(row));
    const Vec3 com = sums(*s.robot, k, s.physics.gravity).com;
    const Vec3 of_motion(recorded.x[row], recorded.y[row], recorded.z[row]);
    ASSERT_LT((of_motion - com).norm(), 1e-12) << row;  // m; rounding errors of a mean over 33 bodies
  }
}

}  // namespace
}  // namespace gaitlab::test
