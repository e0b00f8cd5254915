// Tests of the sentence on an unstable controller, and of runs that only seem unstable.
#include "report/verdict/instability.h"

#include "core/simulation/simulation_error.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

Recording to_its_end(const Scenario& s) {
  Simulation simulation({&s, 1});
  try {
    simulation.run();
  } catch (const SimulationError& error) {
    Recording record = simulation.take_recording(0);
    record.outcome = error.outcome();
    return record;
  }
  return simulation.take_recording(0);
}

/// Gains for a much shorter control period, and motors that can obey them.
const std::vector<std::string> kTooStiff{"controller.Kp=5000", "actuator.u_max=1e6", "actuator.i_max=1e6", "duration=0.5"};

std::vector<std::string> too_stiff(const std::string& engine) {
  std::vector<std::string> sets = kTooStiff;
  sets.push_back("physics.engine=" + engine);
  return sets;
}

TEST(Unstable, ControllerIsTheOnlySentence) {
  for (const std::string engine : {"articulated", "bullet"}) {
    for (const std::string file : {"caterpillar.yaml", "hexapod.yaml", "library/y1-snake.yaml"}) {
      if (engine == "bullet" && file != "caterpillar.yaml") continue;
      const Scenario s = shipped(file, too_stiff(engine));
      const Recording record = to_its_end(s);
      const Verdict made = verdict(s, record, summarise(s, record, 0), Overlaps());
      const std::string text = instability(s, record);
      EXPECT_TRUE(text.starts_with("the controller is unstable from 0.0")) << file << engine << text;
      EXPECT_TRUE(contains(text, "(Kp 5000 V/rad, ")) << text;
      EXPECT_TRUE(contains(text, " rad beyond its range")) << text;
      EXPECT_EQ(made.why(), text) << file;
      EXPECT_NE(made.word, Word::feasible) << file;
      EXPECT_EQ(made.count(CheckStatus::pass), 0U) << file;
    }
  }
}

/// A motor that cannot obey ends in a limit cycle of its voltage, and the joints stay within their ranges.
TEST(Unstable, IsNoControllerAtTheLimitOfItsMotor) {
  for (const char* file : {"caterpillar.yaml", "hexapod.yaml"}) {
    const Scenario s = shipped(file, {"controller.Kp=5000", "duration=1", "physics.engine=articulated"});
    EXPECT_EQ(instability(s, to_its_end(s)), "") << file;
  }
}

/// Rows at 0, 0.1, ... 0.4 s of a caterpillar, whose first joint has a command that reverses from 0.2 s on.
struct Reversing {
  Reversing() {
    scenario = shipped("caterpillar.yaml");
    record.joints.resize(scenario.robot->joints.size());
    record.joints[0].reversals = 3;
    record.joints[0].reversing_from = 0.2;
    record.poses.columns = pose_columns(record.joints.size());
    for (int k = 0; k < 5; ++k) {
      record.poses.values.resize(record.poses.values.size() + record.poses.columns.size());
      record.poses.values[static_cast<std::size_t>(k) * record.poses.columns.size()] = 0.1 * k;
    }
  }
  double& at(const std::string& column, int row) {
    return record.poses.values[static_cast<std::size_t>(row) * record.poses.columns.size() + record.poses.find(column)];
  }
  [[nodiscard]] std::string text() const { return instability(scenario, record); }
  Scenario scenario;
  Recording record;
};

TEST(Unstable, OnlyIfTheJointLeavesItsRangeWhileItsCommandReverses) {
  Reversing told;
  const double hi = told.scenario.robot->joints[0].hi;
  told.at("joint.0.angle", 1) = hi + 5;
  told.at("joint.0.angle", 3) = hi + 5;
  EXPECT_EQ(told.text(), "") << "already before the command reverses";
  told.at("joint.0.angle", 1) = 0;
  told.at("joint.0.angle", 3) = hi + 0.9;
  EXPECT_EQ(told.text(), "");
  told.at("joint.0.angle", 3) = hi + 1.2;
  EXPECT_TRUE(contains(told.text(), "unstable from 0.2 s on")) << told.text();
  EXPECT_TRUE(contains(told.text(), "goes 1.2 rad beyond its range")) << told.text();
  told.record.joints[1] = told.record.joints[0];
  told.at("joint.1.angle", 3) = told.scenario.robot->joints[1].hi + 1.1;
  EXPECT_TRUE(contains(told.text(), "goes 1.2 rad beyond its range")) << "the farther of two joints; " << told.text();
  told.record.joints[0].reversals = told.record.joints[1].reversals = 0;
  EXPECT_EQ(told.text(), "");
}

TEST(Unstable, OnlyIfTheBaseIsFasterThanItsFallExplains) {
  Reversing told;
  const auto fly = [&](double speed, double height) {
    for (int k = 0; k < 5; ++k) {
      told.at("base.x", k) = 0.1 * std::max(0, k - 2) * speed;          // from 0.2 s on
      told.at("base.z", k) = height * (k == 0 ? 1 : k == 1 ? 0.5 : 0);  // the vertical speed is below 10 m/s
    }
  };
  fly(9, 0);
  EXPECT_EQ(told.text(), "");
  fly(12, 0);
  EXPECT_TRUE(contains(told.text(), "throws the base about at 12 m/s")) << told.text();
  fly(11, 1.8);  // twice the speed of a fall from there is 11.9 m/s
  EXPECT_EQ(told.text(), "");
  fly(14, 1.8);
  EXPECT_TRUE(contains(told.text(), "throws the base about at 14 m/s")) << told.text();
}

}  // namespace
}  // namespace gaitlab::test
