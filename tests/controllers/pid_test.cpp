// Tests of the controller `pid` alone: commands for a sequence of errors agree with values computed by hand and with closed
// forms.
#include "controllers/pid.h"

#include <gtest/gtest.h>

#include "tests/oracles/drives.h"
#include "tests/random_robots.h"

namespace gaitlab::test {
namespace {

using namespace controllers;

/// Controller of several joints that receives errors tick by tick.
class Fed {
 public:
  Fed(std::size_t joints, Pid::Settings settings, double period, double limit)
      : zero_(joints),
        limit_(joints, limit),
        measured_{0, period, zero_, zero_, {}, {}},
        pid_(robot(joints), std::move(settings)),
        x_(pid_.states()),
        command_(joints) {
    pid_.start(x_);
  }
  /// Commands for these errors. The angles are 0, so that the set points equal the errors.
  const std::vector<double>& operator()(const std::vector<double>& error) {
    pid_.update(measured_, error, limit_, x_, command_);
    return command_;
  }

 private:
  static RobotInfo robot(std::size_t joints) {
    RobotInfo info;
    info.joints.resize(joints);
    return info;
  }
  std::vector<double> zero_, limit_;
  Measured measured_;
  Pid pid_;
  std::vector<double> x_, command_;
};

TEST(Pid, HoldsTheIntegralAfterATickBeyondTheLimitOnTheErrorsSide) {
  // Ki Ts = 1/2. The first command, 2 V, exceeds the limit of 1 V and has the sign of the error. The error of this tick is
  // therefore never added to the integral, for either sign of the next error.
  Pid::Settings settings;
  settings.Kp.common = 2;
  settings.Ki.common = 4;
  settings.Kd.common = 0;
  const auto commands = [&](double limit) {
    Fed pid(1, settings, 0.125, limit);
    std::vector<double> all;
    for (const double error : {1.0, -0.25, -0.25}) all.push_back(pid({error})[0]);
    return all;
  };
  EXPECT_EQ(commands(1), (std::vector<double>{2, -0.5, -0.5 - 0.125}));
  EXPECT_EQ(commands(2), (std::vector<double>{2, -0.5 + 0.5, -0.5 + 0.5 - 0.125}));  // a command equal to the limit counts
  settings.anti_windup = false;
  EXPECT_EQ(commands(1), (std::vector<double>{2, -0.5 + 0.5, -0.5 + 0.5 - 0.125}));
}

TEST(Pid, TakesTheIntegralBackWhileTheErrorIsOnTheOtherSide) {
  // Ki Ts = 1.
  Pid::Settings settings;
  settings.Kp.common = 0.5;
  settings.Ki.common = 8;
  settings.Kd.common = 0;
  Fed pid(1, settings, 0.125, 2);
  EXPECT_EQ(pid({1})[0], 0.5);
  EXPECT_EQ(pid({1})[0], 1.5);
  EXPECT_EQ(pid({1})[0], 2 + 0.5);
  EXPECT_EQ(pid({-0.5})[0], 2 - 0.25);  // integral unchanged, because 2.5 exceeded the limit with the sign of the error
  EXPECT_EQ(pid({2})[0], 1.5 + 1);
  EXPECT_EQ(pid({-2})[0], 1.5 - 1);  // integral unchanged
  EXPECT_EQ(pid({4})[0], -0.5 + 2);
  EXPECT_EQ(pid({-1})[0], 3.5 - 0.5);    // beyond the limit, but with an error of opposite sign
  EXPECT_EQ(pid({0.5})[0], 2.5 + 0.25);  // the integral includes that error
}

TEST(Pid, AnswersAStepWithADerivativeThatDecays) {
  // With Kd = 1 and N Ts = 1, half of the filter state remains from tick to tick, and a step of 1 gives N Kd / (Kd + N Ts) = 4.
  Pid::Settings settings;
  settings.Kp.common = 0;
  settings.Kd.common = 1;
  settings.N.common = 8;
  Fed pid(1, settings, 0.125, 100);
  std::vector<double> commands;
  for (const double error : {0.0, 0.0, 1.0, 1.0, 1.0}) commands.push_back(pid({error})[0]);
  EXPECT_EQ(commands, (std::vector<double>{0, 0, 4, 2, 1}));
}

TEST(Pid, IsTheSumsForRandomErrors) {
  RandomRobots random(51);
  double worst = 0;
  int held = 0;
  int turned = 0;
  for (int i = 0; i < 100; ++i) {
    constexpr std::size_t kJoints = 3;
    constexpr std::size_t kTicks = 60;
    const double period = random.scaled(1e-3, 0.1);
    const double limit = random.scaled(0.3, 3);
    Pid::Settings settings;
    std::vector<oracle::PidSums> sums;
    for (std::size_t j = 0; j < kJoints; ++j) {
      const double kp = random.scaled(0.1, 10);
      const double ki = random.scaled(0.01, 1) / period;
      const double kd = random.below(3) == 0 ? 0 : random.scaled(0.01, 1);
      const double n = random.scaled(1, 100);
      settings.Kp.each.push_back(kp);
      settings.Ki.each.push_back(ki);
      settings.Kd.each.push_back(kd);
      settings.N.each.push_back(n);
      sums.emplace_back(kp, ki, kd, n, period, limit);
    }
    settings.anti_windup = i % 4 != 0;
    if (!settings.anti_windup) {
      for (std::size_t j = 0; j < kJoints; ++j) {
        sums[j] = {settings.Kp[j], settings.Ki[j], settings.Kd[j], settings.N[j], period, 1e300};
      }
    }
    Fed pid(kJoints, settings, period, limit);
    std::vector<double> error(kJoints);
    for (std::size_t tick = 0; tick < kTicks; ++tick) {
      const std::vector<double> before = error;
      for (double& e : error) e = random.uniform(-1, 1);
      const std::vector<double>& command = pid(error);
      for (std::size_t j = 0; j < kJoints; ++j) {
        const double expected = sums[j](error[j]);
        worst = std::max(worst, std::abs(command[j] - expected) / (1 + std::abs(expected)));
        if (tick == 0 || !sums[j].held(tick - 1)) continue;
        ++held;
        turned += before[j] * error[j] < 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(turned, 300) << "ticks after which the error has the other sign";
  // The tolerance is for the rounding errors of 60 sums of numbers up to 100. No command equals its limit up to rounding, which
  // the two formulas would treat differently.
  EXPECT_LT(worst, 1e-12);
}

}  // namespace
}  // namespace gaitlab::test
