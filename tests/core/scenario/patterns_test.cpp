// Tests of patterns in scenarios: in all values per joint, on the command line, in lists of names, and in resolved scenarios.
#include <gtest/gtest.h>

#include "core/settings/joint_patterns.h"
#include "tests/core/scenario/fixture.h"

namespace gaitlab {
namespace {

using fakes::kTwo;
using fakes::ScenarioTest;

double resistance(const Scenario& s, std::size_t joint) {
  return static_cast<const fakes::Motor::Settings*>(s.actuator.settings.get())->R[joint];
}

TEST_F(ScenarioTest, PatternsAreWrittenOutPerJoint) {
  const Scenario by_pattern = read(kTwo + "actuator: {R: {\"*/h\": 3, m1/h: 5}}\ninitial: {angles: {\"m?/h\": 0.5}}\n");
  const Scenario by_list = read(kTwo + "actuator: {R: [3, 5]}\ninitial: {angles: [0.5, 0.5]}\n");
  EXPECT_EQ(resistance(by_pattern, 0), 3);
  EXPECT_EQ(resistance(by_pattern, 1), 5);
  EXPECT_EQ(resolved(by_pattern), resolved(by_list));
  expect_stable(by_pattern);
}

TEST_F(ScenarioTest, PatternsOnTheCommandLine) {
  const std::string text = kTwo + "actuator: {R: 2}\n";
  EXPECT_EQ(resolved(read(text, {"actuator.R.m1/h=5"})), resolved(read(kTwo + "actuator: {R: [2, 5]}\n")));
  EXPECT_EQ(resolved(read(text, {"actuator.R.m1/*=5"})), resolved(read(kTwo + "actuator: {R: [2, 5]}\n")));
  EXPECT_EQ(resolved(read(text, {"actuator.R={default: 2, \"*1/h\": 5}"})), resolved(read(kTwo + "actuator: {R: [2, 5]}\n")));
  EXPECT_EQ(error(text, {"actuator.R.m2/h=5"}), "--set actuator.R.m2/h=5: error: no joint 'm2/h'; joints are m0/h, m1/h");
  EXPECT_EQ(error(text, {"actuator.R.m2/*=5"}),
            "--set actuator.R.m2/*=5: error: no joint matches 'm2/*'; did you mean 'm0/*'?");
  // The message of a conflict between file and command line contains both places.
  EXPECT_EQ(
      error(kTwo + "actuator: {R: {\"*/h\": 2}}\n", {"actuator.R.m1/*=5"}),
      "--set actuator.R.m1/*=5: error: joint 'm1/h' is given 2 by '*/h' and 5 by 'm1/*'; give it by its name, which beats "
      "patterns\nDIR/s.yaml:5:16: note: '*/h' is here");
  // The message for a setting that is not per joint states this.
  EXPECT_EQ(error(kTwo, {"duration.m1/h=5"}), "DIR/s.yaml:4:11: error: duration is a map; expected a number in s");
}

TEST_F(ScenarioTest, AnAngleOutOfRangeIsReportedAtItsPattern) {
  EXPECT_EQ(error(kTwo + "initial: {angles: {default: 0, m1/*: 2}}\n"),
            "DIR/s.yaml:5:38: error: the initial angle of joint 'm1/h' is 2 rad; expected -1.5 to 1.5 rad");
}

TEST_F(ScenarioTest, JointsOfTheFigureByPattern) {
  const auto shown = [&](const std::string& list) { return read(kTwo + "figure: {joints: " + list + "}\n").figure.joints; };
  EXPECT_EQ(shown("[\"*\"]"), (std::vector<std::string>{"m0/h", "m1/h"}));
  EXPECT_EQ(shown("[m1/h, \"*/h\"]"), (std::vector<std::string>{"m1/h", "m0/h"})) << "in the order of the list";
  EXPECT_EQ(shown("[m1/*]"), (std::vector<std::string>{"m1/h"}));
  expect_stable(read(kTwo + "figure: {joints: [\"*\"]}\n"));
  EXPECT_EQ(error(kTwo + "figure: {joints: [m0/h, m3/*]}\n"),
            "DIR/s.yaml:5:25: error: no joint matches 'm3/*'; did you mean 'm0/*'?");
}

TEST(JointPatterns, OfARobotWithoutJoints) {
  EXPECT_TRUE(joints_of("*", {}).empty());
  EXPECT_EQ(no_joint("*", {}), "no joint matches '*'; there are no joints");
  EXPECT_EQ(joints_meant({"*"}, {}), std::vector<std::string>{"*"});
  EXPECT_TRUE(joints_meant({}, {"m0/h"}).empty());
}

TEST(JointPatterns, InNamesOfColumns) {
  const std::vector<std::string> joints{"m0/a", "m0/b", "m1/a", "m1/b", "m2/a", "m2/b", "m3/a", "m3/b", "m4/a", "m4/b", "m5/a"};
  const JointGroups groups{{"hips", {"m0/b", "m5/a"}}};
  const auto chosen = [&](const std::string& text) {
    std::string numbers;
    const ColumnChoice choice(text, joints, groups);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (choice.has("joint." + std::to_string(j) + ".torque")) numbers += std::to_string(j) + " ";
    }
    return numbers;
  };
  EXPECT_EQ(chosen("joint.hips.torque"), "1 10 ");
  EXPECT_EQ(chosen("joint.m5/a.torq*"), "10 ");
  EXPECT_EQ(chosen("joint.m[1-2]/b.*ue"), "3 5 ");
  EXPECT_EQ(chosen("joint.1.torque"), "1 ") << "a number is that of a joint";
  EXPECT_EQ(chosen("joint.hips.speed"), "");
  EXPECT_EQ(chosen("joint.knees.torque"), "");
  EXPECT_EQ(chosen("reaction.hips.torque"), "");
  EXPECT_TRUE(ColumnChoice("reaction.hips.m?", joints, groups).has("reaction.10.my"));
  EXPECT_FALSE(ColumnChoice("reaction.hips.m?", joints, groups).has("reaction.m1/dock.my"));
  EXPECT_TRUE(ColumnChoice("reaction.m1/dock.my", joints, groups).has("reaction.m1/dock.my"));
  EXPECT_FALSE(ColumnChoice("joint.", joints, groups).has("joint.0.torque"));
}

TEST(JointPatterns, AHostileTextIsCheapAndShort) {
  const std::vector<std::string> joints{"m0/h", "m1/h"};
  EXPECT_EQ(no_joint(std::string(100000, '*') + "x", joints),
            "no joint matches '" + std::string(60, '*') + "...'; known joints: m0/h, m1/h");
}

}  // namespace
}  // namespace gaitlab
