// The articulated step is one template: with a scalar of two lanes it must give each lane the bits it has alone.
#include <gtest/gtest.h>

#include "core/math/functions.h"
#include "core/math/lanes.h"

// A lane type in its plainest form: two doubles, and what core/math/lanes.h asks for. (Before the headers that use it.)
namespace gaitlab::math {

struct TwoBools {
  bool a, b;
};

struct Two {
  double a = 0, b = 0;
  Two() = default;
  Two(double both)
      : a(both), b(both) {}  // NOLINT(google-explicit-constructor): constants of the model are the same in all lanes
  Two(double x, double y) : a(x), b(y) {}
  friend Two operator+(Two x, Two y) { return {x.a + y.a, x.b + y.b}; }
  friend Two operator-(Two x, Two y) { return {x.a - y.a, x.b - y.b}; }
  friend Two operator*(Two x, Two y) { return {x.a * y.a, x.b * y.b}; }
  friend Two operator/(Two x, Two y) { return {x.a / y.a, x.b / y.b}; }
  friend Two operator-(Two x) { return {-x.a, -x.b}; }
  friend TwoBools operator<(Two x, Two y) { return {x.a < y.a, x.b < y.b}; }
  friend TwoBools operator>(Two x, Two y) { return y < x; }
  friend TwoBools operator>=(Two x, Two y) { return {x.a >= y.a, x.b >= y.b}; }
  friend TwoBools operator<=(Two x, Two y) { return y >= x; }
};

struct TwoSinCos {
  Two sin, cos;
};
inline TwoSinCos sincos(Two x) {
  const SinCos a = sincos(x.a);
  const SinCos b = sincos(x.b);
  return {{a.sin, b.sin}, {a.cos, b.cos}};
}
inline Two pow(Two x, double e) { return {pow(x.a, e), pow(x.b, e)}; }
inline Two sqrt(Two x) { return {sqrt(x.a), sqrt(x.b)}; }
inline Two select(TwoBools mask, Two yes, Two no) { return {mask.a ? yes.a : no.a, mask.b ? yes.b : no.b}; }
inline TwoBools both(TwoBools x, TwoBools y) { return {x.a && y.a, x.b && y.b}; }
inline TwoBools either(TwoBools x, TwoBools y) { return {x.a || y.a, x.b || y.b}; }
inline TwoBools fresh(TwoBools yes, TwoBools already) { return {yes.a && !already.a, yes.b && !already.b}; }
inline bool any(TwoBools mask) { return mask.a || mask.b; }
inline std::span<double> numbers(std::span<Two> x) { return {&x.data()->a, 2 * x.size()}; }

}  // namespace gaitlab::math

#include "actuators/dc_motor.h"
#include "core/simulation/start.h"
#include "physics_articulated/stepper.h"
#include "tests/random_robots.h"

namespace gaitlab::test {
namespace {

using math::Two;

std::string method_name(const testing::TestParamInfo<int>& method) {
  constexpr std::array kNames{"implicit", "extrapolated", "rk4"};
  return kNames[static_cast<std::size_t>(method.param)];
}

class Lanes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Of, Lanes, testing::Values(0, 1, 2), method_name);

TEST_P(Lanes, GiveEveryRolloutTheBitsItHasAlone) {
  RandomRobots random(41);
  double rubbed = 0;  // J: something slides in some lane
  for (int i = 0; i < 6; ++i) {
    PlantSettings settings;
    settings.robot = std::make_shared<const Robot>(random.robot_of(4));
    const Robot& robot = *settings.robot;
    settings.gravity = {0.5, 0.3, -9.81};
    settings.integrator = GetParam();
    settings.contacts = contact_elements(robot, ContactSet::all);
    for (std::size_t l = 0; l < robot.links.size(); ++l) {  // made-up types have no elements of their own
      ContactElement element;
      element.link = l;
      element.radius = 0.05;
      settings.contacts.push_back(element);
    }
    settings.law.k = 1.5;
    const articulated::Tree tree(robot, settings.base, settings.contacts);
    DcMotorActuator::Settings weak;
    weak.i_max = PerJoint{0.2};
    DcMotorActuator::Settings directional;
    directional.efficiency_model = 1;
    const std::array<const DcMotorActuator::Settings*, 2> motors{&weak, &directional};

    const std::size_t n = robot.joints.size();
    const StateLayout alone{n, 1};
    const StateLayout beside{n, 2};
    std::vector<double> numbers(beside.size());
    std::vector<double> commands(2 * n);
    for (double& u : commands) u = random.uniform(-8, 8);
    std::array<std::vector<double>, 2> lane;
    for (std::size_t l = 0; l < 2; ++l) {
      RobotState state = random.state(robot, settings.base);
      state.position.z() = 0.1;  // through the ground here, in the air there
      beside.write(state, l, numbers);
      lane[l].resize(alone.size());
      alone.write(state, 0, lane[l]);
    }
    std::vector<Two> together(alone.size());
    for (std::size_t e = 0; e < together.size(); ++e) together[e] = {numbers[2 * e], numbers[2 * e + 1]};

    const double h = GetParam() == 2 ? 2e-5 : 5e-4;
    const DcMotorActuator both(info(robot), {motors[0], motors[1]});
    settings.actuator = &both;
    settings.lanes = 2;
    articulated::Stepper<Two> two(tree, settings);
    for (int step = 0; step < 60; ++step) two.step(together, commands, h);
    for (std::size_t l = 0; l < 2; ++l) {
      const DcMotorActuator own(info(robot), {motors[l]});
      settings.actuator = &own;
      settings.lanes = 1;
      std::vector<double> command(n);
      for (std::size_t j = 0; j < n; ++j) command[j] = commands[2 * j + l];
      articulated::Stepper<double> one(tree, settings);
      for (int step = 0; step < 60; ++step) one.step(lane[l], command, h);
      for (std::size_t e = 0; e < alone.size(); ++e) {
        EXPECT_EQ(l == 0 ? together[e].a : together[e].b, lane[l][e]) << "robot " << i << ", lane " << l << ", entry " << e;
        EXPECT_LT(std::abs(lane[l][e]), 1e5);
      }
      EXPECT_EQ(l == 0 ? two.done.friction.a : two.done.friction.b, one.done.friction);
      rubbed += one.done.friction;
    }
  }
  EXPECT_GT(rubbed, 0);
}

}  // namespace
}  // namespace gaitlab::test
