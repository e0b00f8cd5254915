// Tests of the CPG `network`: its outputs agree with sums written out, and networks that do not fit are refused.
#include "cpg/network.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gaitlab::test {
namespace {

using cpg::Network;

RobotInfo robot_of_three() {
  RobotInfo robot;
  for (const char* name : {"m0/a", "m0/b", "m1/a"}) {
    JointInfo joint;
    joint.name = name;
    joint.lo = -1.6;
    joint.hi = 1.6;
    robot.joints.push_back(joint);
  }
  robot.joints[1].driven = false;
  robot.modules.resize(2);
  robot.channels = {"imu.roll"};
  return robot;
}

Network::Settings small() {
  Network::Settings s;
  s.frequency = 0.5;
  s.model.inputs = {"angle.*", "imu.roll", "touching.m1", "previous.m1/a", "clock.cos"};
  s.model.mean = {0, 0.1, 0, 0, 0, 0, 0};
  s.model.deviation = {1, 2, 1, 0.1, 1, 1, 1};
  s.model.clip = 3;
  s.model.layers = {{{{1, 2, 3, 4, 5, 6, 7}, {0, 0, 0, 0, 0, 0, 1}}, {0.5, 0}, Network::Activation::tanh},
                    {{{1, -1}, {2, 0}}, {}, Network::Activation::none}};
  s.model.centre = {0.2};
  s.model.scale = {0.1};
  return s;
}

TEST(Network, IsItsSums) {
  const Network network(robot_of_three(), small());
  ASSERT_EQ(network.states(), 2U);
  std::vector<double> x{0, 0.25}, setpoint(3);
  const std::vector<double> angle{0.3, -0.1, 0.2}, none(3), touching{0, 1}, channels{0.5};
  const double t = 0.7;
  network.event({t, 0.015, angle, none, none, touching, channels, none}, x);
  const double clock = std::cos(std::numbers::pi * t);
  const double first =
      std::tanh(0.3 + 2 * (-0.1 - 0.1) / 2 + 3 * 0.2 + 4 * 3 /* 0.5/0.1, clipped */ + 5 * 1 + 6 * 0.25 + 7 * clock + 0.5);
  const double second = std::tanh(clock);
  EXPECT_NEAR(x[0], first - second, 1e-15);
  EXPECT_NEAR(x[1], 2 * first, 1e-15);
  network.output(t, x, setpoint);
  EXPECT_NEAR(setpoint[0], 0.2 + 0.1 * (first - second), 1e-15);
  EXPECT_EQ(setpoint[1], 0);  // without a motor
  EXPECT_NEAR(setpoint[2], 0.2 + 0.2 * first, 1e-15);
  EXPECT_DOUBLE_EQ(network.times().period, 2);
}

TEST(Network, ActivationsAreThoseOfTheirNames) {
  const std::vector<std::pair<Network::Activation, double>> rows{{Network::Activation::tanh, std::tanh(-0.5)},
                                                                 {Network::Activation::relu, 0},
                                                                 {Network::Activation::elu, std::exp(-0.5) - 1},
                                                                 {Network::Activation::none, -0.5}};
  for (const auto& [activation, expected] : rows) {
    Network::Settings s;
    s.model.layers = {{{{0, 0}, {0, 0}}, {-0.5, 0.5}, activation}};
    const Network network(robot_of_three(), s);
    std::vector<double> x(2);
    const std::vector<double> none(3);
    network.event({0, 0.015, none, none, none, none, {}, none}, x);
    EXPECT_NEAR(x[0], expected, 1e-15);
  }
}

TEST(Network, RefusesWhatDoesNotFit) {
  const auto refused = [](const auto& change, const std::string& text) {
    Network::Settings s = small();
    change(s);
    try {
      const Network network(robot_of_three(), s);
      ADD_FAILURE() << text;
    } catch (const SettingError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  refused([](auto& s) { s.model.inputs[0] = "imu.role"; }, "'imu.role' is unknown");
  refused([](auto& s) { s.model.mean = {1}; }, "model.mean has 1 numbers; the network has 7 inputs");
  refused([](auto& s) { s.model.layers[0].weights[0].pop_back(); }, "layer 0 has 6 inputs, the inputs give 7");
  refused([](auto& s) { s.model.layers[1].weights = {{1}}; }, "layer 1 has 1 inputs, layer 0 gives 2");
  refused([](auto& s) { s.model.layers[1].weights = {{1, 1}}; }, "the last layer gives 1 numbers; the robot has 2 motors");
  refused([](auto& s) { s.model.layers[0].bias = {1}; }, "2 rows of weights and 1 biases");
  refused([](auto& s) { s.model.centre = {57}; }, "57 degrees are 0.9948 rad");
}

}  // namespace
}  // namespace gaitlab::test
