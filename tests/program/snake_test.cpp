// CPG `snake` against the set points of shipped gaits of chains, whose phases are lists by hand.
#include "cpg/snake.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/sensor_section.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using cpg::Snake;

/// Largest difference of the set points from those of the scenario, at times within the ramp and after it, rad.
double apart(const std::string& name, const Snake::Settings& settings) {
  const Scenario s = shipped("library/" + name);
  const RobotInfo robot = plugin_info(s);
  const Snake snake(robot, settings);
  const std::unique_ptr<Cpg> sine = make_cpg(s.cpg, robot);
  std::vector<double> ours(robot.joints.size()), theirs(robot.joints.size());
  double most = 0;
  for (const double t : {0.0, 0.3, 1.0, 1.7, 12.34}) {
    snake.output(t, {}, ours);
    sine->output(t, {}, theirs);
    for (std::size_t j = 0; j < ours.size(); ++j) most = std::max(most, std::abs(ours[j] - theirs[j]));
  }
  return most;
}

/// The lists have seven digits. Yaw joints of that robot turn about -z, so that a half turn of phase is added.
TEST(Snake, HasTheSetPointsOfShippedGaits) {
  Snake::Settings straight;
  straight.model.pitch.amplitude = 0.4;
  EXPECT_LT(apart("y1-snake.yaml", straight), 1e-6);
  Snake::Settings rolling;
  rolling.model.pitch = {0.3, 0, 0};
  rolling.model.yaw = {0.3, 0, 0};
  rolling.model.shift = 1.5707963 + std::numbers::pi;
  EXPECT_LT(apart("y1-rolling.yaml", rolling), 1e-6);
  Snake::Settings sidewinding;
  sidewinding.model.pitch = {0.25, 1.5707963, 0};
  sidewinding.model.yaw = {0.5, 1.5707963, 0};
  sidewinding.model.shift = 2.0943951 + std::numbers::pi;
  EXPECT_LT(apart("y1-sidewinding.yaml", sidewinding), 1e-6);
}

/// Axes about -y and -z turn the other way, so that the joints of every assembly move alike; offsets are there from the start.
TEST(Snake, KindsAndSignsOfJoints) {
  RobotInfo robot;
  for (const std::array<double, 3>& axis :
       {std::array{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -0.8, 0.6}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}}) {
    JointInfo joint;
    joint.parent = static_cast<std::int64_t>(robot.joints.size()) - 1;
    joint.lo = -3;
    joint.hi = 3;
    joint.axis = axis;
    robot.joints.push_back(joint);
  }
  Snake::Settings s;
  s.model.yaw.offset = 0.3;
  const Snake snake(robot, s);
  std::vector<double> q(5);
  snake.output(0, {}, q);
  EXPECT_EQ(q, (std::vector<double>{0, 0.3, 0, -0.3, 0}));
  snake.output(1.25, {}, q);  // 0.625 of a cycle
  const double cycle = 2 * std::numbers::pi * 0.625;
  EXPECT_NEAR(q[0], 0.6 * std::sin(cycle), 1e-12);
  EXPECT_NEAR(q[2], -0.6 * std::sin(cycle + 2.0943951), 1e-12) << "an axis about -y";
  EXPECT_EQ(snake.note(), "2 pitch and 2 yaw joints");
  robot.joints.push_back(robot.joints.back());  // a second joint on the same parent
  EXPECT_EQ(Snake(robot, s).note(), "2 pitch and 2 yaw joints; the robot branches: in each branch the waves begin at the base");
}

TEST(Snake, RefusesWavesWithoutJoints) {
  const auto with = [](const char* name, const std::vector<std::string>& sets) {
    return message_of([&] { shipped(name, sets); });
  };
  EXPECT_TRUE(contains(with("caterpillar.yaml", {"cpg={type: snake, model: {yaw: {offset: 0.3}}}"}),
                       "model.yaw moves no joint: none with a motor turns about z; dock every other module with a turn of 1"));
  EXPECT_TRUE(contains(with("library/y1-snake.yaml", {"cpg={type: snake, model: {pitch: {amplitude: 3, offset: 0.5}}}"}),
                       "expected -3.2 to 3.2 rad"));
}

}  // namespace
}  // namespace gaitlab::test
