// Tests of the controller `rc_servo` alone: duties for sequences of errors agree with values computed by hand, its profile with
// that of uniform acceleration.
#include "controllers/rc_servo.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gaitlab::test {
namespace {

using controllers::RcServo;

/// Controller of one joint that is fed tick by tick.
class FedServo {
 public:
  FedServo(RcServo::Settings settings, double period)
      : period_(period), servo_(robot(period), std::move(settings)), x_(servo_.states()) {
    servo_.start(x_);
  }
  double operator()(double setpoint, double angle = 0) {
    const std::vector<double> at{angle};
    const std::vector<double> zero{0};
    const std::vector<double> goal{setpoint};
    servo_.update({0, period_, at, zero, zero, zero}, goal, zero, x_, command_);
    return command_[0];
  }

 private:
  static RobotInfo robot(double period) {
    RobotInfo info;
    info.joints.resize(1);
    info.control_period = period;
    return info;
  }
  double period_;
  RcServo servo_;
  std::vector<double> x_, command_{0};
};

RcServo::Settings with_gain(double gain) {
  RcServo::Settings settings;
  settings.gain.common = gain;
  return settings;
}

TEST(RcServo, DutyIsThatOfItsManual) {
  RcServo::Settings settings = with_gain(2);
  settings.dead_band.common = 0.25;
  settings.punch.common = 0.125;
  FedServo band(settings, 0.5);
  EXPECT_EQ(band(0.25), 0);
  EXPECT_EQ(band(-0.25), 0);
  EXPECT_EQ(band(0.5), 2 * 0.25 + 0.125);
  EXPECT_EQ(band(-0.5), -2 * 0.25 - 0.125);
  EXPECT_EQ(band(2), 2 * 1.75 + 0.125) << "the motor's limit cuts the duty, so that it counts as at the supply";
  settings = with_gain(2);
  settings.D.common = 0.25;
  FedServo rate(settings, 0.5);
  EXPECT_EQ(rate(1), 2) << "no rate at the first sample";
  EXPECT_EQ(rate(2), 4 + 0.25 * 1 / 0.5);
  EXPECT_EQ(rate(1, 1), 0 - 0.25 * 2 / 0.5);
}

TEST(RcServo, HoldsTheIntegralBeyondTheLimitAndInTheDeadBand) {
  RcServo::Settings settings = with_gain(0.5);
  settings.I.common = 1;  // I T = 1/2
  settings.dead_band.common = 0.125;
  FedServo servo(settings, 0.5);
  EXPECT_EQ(servo(1), 0.5 * 0.875 + 0.5);
  EXPECT_EQ(servo(0.125), 0);
  EXPECT_EQ(servo(1), 0.5 * 0.875 + 1) << "0.0625 less than with the sample in the dead band";
  EXPECT_EQ(servo(1), 0.5 * 0.875 + 1) << "the last duty, 1.44, exceeded the limit with the sign of the error";
  EXPECT_EQ(servo(-1), -0.5 * 0.875 + 0.5);
}

TEST(RcServo, SamplesEveryFewPeriodsAndHolds) {
  RcServo::Settings settings = with_gain(2);
  settings.every = 3;
  settings.D.common = 3;
  FedServo servo(settings, 0.5);
  std::vector<double> duties;
  for (const double goal : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) duties.push_back(servo(goal));
  EXPECT_EQ(duties, (std::vector<double>{2, 2, 2, 8 + 6, 8 + 6, 8 + 6})) << "rate 3 / (3 0.5 s)";
}

TEST(RcServo, GoalActsAfterTheLatency) {
  for (const auto& [latency, ticks] :
       {std::pair{0.0, 0}, std::pair{0.0625, 1}, std::pair{0.5, 1}, std::pair{1.0, 2}, std::pair{1.01, 3}}) {
    RcServo::Settings settings = with_gain(1);
    settings.latency.common = latency;
    FedServo servo(settings, 0.5);
    for (int k = 0; k < 6; ++k) {
      const double sent = k - ticks < 0 ? 0.25 : k - ticks + 1.0;
      EXPECT_EQ(servo(k + 1.0, k == 0 ? 0.25 : 0), k == 0 ? sent - 0.25 : sent) << latency << " at tick " << k;
    }
  }
}

TEST(RcServo, ProfileIsThatOfUniformAcceleration) {
  // 2 rad at most 4 rad/s and 16 rad/s^2: 0.25 s up, 0.25 s at full speed, 0.25 s down.
  constexpr double kPeriod = 0.001;
  RcServo::Settings settings = with_gain(1);
  settings.speed_limit.common = 4;
  settings.acceleration_limit.common = 16;
  FedServo servo(settings, kPeriod);
  double last = 0;
  double speed = 0;
  for (int k = 1; k <= 900; ++k) {
    const double t = k * kPeriod;
    const double goal = servo(2);
    const double expected = t < 0.25   ? 8 * t * t
                            : t < 0.5  ? 0.5 + 4 * (t - 0.25)
                            : t < 0.75 ? 2 - 8 * (0.75 - t) * (0.75 - t)
                                       : 2;
    EXPECT_NEAR(goal, expected, 4 * kPeriod * 1.01) << t << " s; one sample at full speed";
    const double now = (goal - last) / kPeriod;
    EXPECT_LE(now, 4 + 1e-9);
    EXPECT_LE(std::abs(now - speed), 16 * kPeriod + 1e-9) << t;
    last = goal;
    speed = now;
  }
  EXPECT_EQ(last, 2) << "no overshoot, and at the goal exactly";
  settings.acceleration_limit.common = 0;
  FedServo even(settings, 0.125);
  EXPECT_EQ(even(2), 0.5);
  EXPECT_EQ(even(2), 1);
  settings.speed_limit.common = 0;
  settings.acceleration_limit.common = 16;
  FedServo steep(settings, 0.125);
  EXPECT_EQ(steep(2), 0.25) << "16 rad/s^2 for a sample of 1/8 s";
}

/// The profile stops at every goal, also between those that a whole number of samples of its acceleration reaches.
TEST(RcServo, ProfileStopsAtEveryGoal) {
  constexpr double kPeriod = 0.125;
  constexpr double kSteepest = 16;
  RcServo::Settings settings = with_gain(1);
  settings.acceleration_limit.common = kSteepest;
  for (int n = 1; n <= 40; ++n) {
    const double goal = 0.137 * n;
    for (const double side : {-1.0, 1.0}) {
      FedServo servo(settings, kPeriod);
      double last = 0;
      double speed = 0;
      for (int k = 0; k < 60; ++k) {
        const double at = side * servo(side * goal);
        const double now = (at - last) / kPeriod;
        EXPECT_GE(at, last - 1e-12) << "goal " << goal << ", sample " << k;
        EXPECT_LE(at, goal + 1e-12) << "goal " << goal << ", sample " << k;
        EXPECT_LE(std::abs(now - speed), kSteepest * kPeriod * (1 + 1e-9)) << "goal " << goal << ", sample " << k;
        last = at;
        speed = now;
      }
      EXPECT_NEAR(last, goal, 1e-12);
    }
  }
}

TEST(RcServo, UnitsOfTheMakers) {
  RcServo::Settings settings;
  settings.P.common = 100;
  EXPECT_NEAR(885 * settings.proportional(0), 253, 2) << "PWM/rad: 252 to 254 in the logs of an XL330 at P 100";
  settings.P.common = 32;
  settings.unit = controllers::FirmwareUnit::feetech_sts;
  EXPECT_NEAR(settings.proportional(0), 5.2765, 1e-3) << "STS3215";
}

/// Latencies of single joints change in a run (section `at`) as long as the longest one stays: the goal is then the set point
/// of the new time.
TEST(RcServo, TheLatencyOfAJointMayChangeInARun) {
  constexpr double kPeriod = 0.5;
  RobotInfo robot;
  robot.joints.resize(2);
  robot.control_period = kPeriod;
  const auto servo = [&](double periods) {
    RcServo::Settings settings = with_gain(1);
    settings.latency.each = {periods * kPeriod, 3 * kPeriod};
    return RcServo(robot, settings);
  };
  const std::vector<double> angle{-1, -1}, zero{0, 0};
  std::vector<double> x(servo(1).states()), command{0, 0};
  const auto goal = [&](int tick, int latency) { return tick < latency ? -1.0 : tick - latency; };
  for (int tick = 0; tick < 20; ++tick) {
    const int latency = tick < 7 ? 1 : tick < 14 ? 3 : tick < 17 ? 2 : 0;
    const double now = tick;
    const std::vector<double> setpoint{now, now};
    servo(latency).update({0, kPeriod, angle, zero, zero, zero}, setpoint, zero, x, command);
    EXPECT_EQ(command[0], goal(tick, latency) + 1) << tick;
    EXPECT_EQ(command[1], goal(tick, 3) + 1) << tick;
  }
}

}  // namespace
}  // namespace gaitlab::test
