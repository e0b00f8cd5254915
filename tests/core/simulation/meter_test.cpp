// Sums and peaks over all steps agree with closed forms of a sine. Each lane has the results that it would have alone.
#include "core/simulation/meter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "core/recording/recording.h"

namespace gaitlab {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Lanes with this many joints, all with motors and the range [-1, 1].
std::vector<Scenario> metered(std::size_t lanes, std::size_t joints) {
  Robot robot;
  for (std::size_t j = 0; j < joints; ++j) robot.joints.push_back({.name = "j" + std::to_string(j), .lo = -1, .hi = 1});
  std::vector<Scenario> all(lanes);
  for (Scenario& one : all) one.robot = std::make_shared<const Robot>(robot);
  return all;
}

/// Everything that Meter::add takes: arrays over joint * lanes + lane, and weights per lane.
struct MeterInput {
  MeterInput(std::size_t lanes, std::size_t joints) : sum(lanes, 0.25), share(lanes, 0.25), measured(lanes, 1.0) {
    for (auto& values : of_joints) values.assign(lanes * joints, 0.0);
    available().assign(lanes * joints, kNoLimit);
  }
  std::vector<double>& angle() { return of_joints[0]; }
  std::vector<double>& speed() { return of_joints[1]; }
  std::vector<double>& torque() { return of_joints[2]; }
  std::vector<double>& setpoint() { return of_joints[3]; }
  std::vector<double>& voltage() { return of_joints[4]; }
  std::vector<double>& current() { return of_joints[5]; }
  std::vector<double>& saturation() { return of_joints[6]; }
  std::vector<double>& power_in() { return of_joints[7]; }
  std::vector<double>& copper() { return of_joints[8]; }
  std::vector<double>& gear() { return of_joints[9]; }
  std::vector<double>& dry() { return of_joints[10]; }
  std::vector<double>& available() { return of_joints[11]; }

  void add_to(Meter& meter, double time) {
    meter.add(time, {torque(), speed(), angle(), sum, share, instant}, setpoint(),
              {voltage(), current(), saturation(), power_in(), copper(), gear()}, dry(), available(), measured);
  }

  std::array<std::vector<double>, 12> of_joints;
  std::vector<double> sum, share, measured;
  bool instant = false;
};

/// Per joint, in the order of TickColumn.
std::vector<double> ticked(Meter& meter, std::size_t lane, std::size_t joints) {
  std::vector<double> row(joints * kTickColumns, -1.0);
  meter.tick(lane, row);
  return row;
}

/// The sum of the squares of N equally spaced samples of whole periods of a sine is N / 2.
TEST(Meter, OfASineIsItsClosedForm) {
  constexpr int kSteps = 400;
  constexpr double kStep = 0.01;
  const std::vector<Scenario> lanes = metered(1, 1);
  Meter meter(lanes);
  MeterInput in(1, 1);
  in.sum = in.share = {kStep};
  for (int k = 0; k < kSteps; ++k) {
    const double phase = 2 * std::numbers::pi * k / 100;
    in.torque() = {0.6 * std::sin(phase)};
    in.speed() = {2 * std::sin(phase)};
    in.current() = {0.4 * std::cos(phase)};
    in.angle() = {0.3 * std::cos(phase)};
    in.power_in() = {1.5};
    in.saturation() = {static_cast<double>(k % 4 == 0 ? 1 : k % 4 == 1 ? 2 : 0)};
    in.add_to(meter, k * kStep);
  }
  const JointStatistics of = meter.statistics(0, 0);
  constexpr double kRounding = kSteps * 1e-16 * 4;  // rounding error of a sum of 400 numbers up to 4
  EXPECT_NEAR(of.torque_rms, 0.6 / std::numbers::sqrt2, kRounding);
  EXPECT_NEAR(of.current_rms, 0.4 / std::numbers::sqrt2, kRounding);
  EXPECT_NEAR(of.error_rms, 0.3 / std::numbers::sqrt2, kRounding);
  EXPECT_NEAR(of.torque_peak, 0.6, kRounding);
  EXPECT_NEAR(of.torque_peak_time, 0.25, kRounding) << "the first of eight equal peaks";
  EXPECT_NEAR(of.speed_peak, 2, kRounding);
  EXPECT_NEAR(of.current_peak, 0.4, kRounding);
  EXPECT_EQ(of.start_jump, 0.3) << "set point 0, angle 0.3 at t = 0";
  EXPECT_NEAR(of.shaft, 0.6 * 2 / 2 * kSteps * kStep, 4 * kRounding);
  EXPECT_NEAR(of.electrical, 1.5 * kSteps * kStep, 4 * kRounding);
  EXPECT_NEAR(of.saturated_voltage, 0.25, kRounding);
  EXPECT_NEAR(of.saturated_current, 0.25, kRounding);
}

/// For two sines a quarter of a period apart, |sin| + |cos| is at most sqrt(2), and its mean square is 1 + 2/pi, here over 100
/// samples.
TEST(Meter, OfTheRobotsCurrentIsThatOfTheSum) {
  constexpr int kSteps = 100;
  const std::vector<Scenario> lanes = metered(1, 2);
  Meter meter(lanes);
  MeterInput in(1, 2);
  in.sum = in.share = {0.01};
  for (int k = 0; k < kSteps; ++k) {
    const double phase = 2 * std::numbers::pi * (k + 0.5) / kSteps;
    in.current() = {std::sin(phase), std::cos(phase)};
    in.add_to(meter, 0.01 * k);
  }
  const auto [peak, rms] = meter.current(0);
  EXPECT_NEAR(peak, std::numbers::sqrt2, 1e-12) << "12.5 steps are an eighth of the period";
  EXPECT_NEAR(rms * rms, 1 + 2 / std::numbers::pi, 1e-3) << "midpoint rule over two kinks in each half period";
}

/// The last stretch in which most commands reverse counts. Zeros do not count, and lanes are independent.
TEST(Meter, OfReversalsIsTheLastStretchOfThem) {
  const std::vector<Scenario> lanes = metered(2, 1);
  Meter meter(lanes);
  const std::vector<double> commands{0, 2, 1, -1, 3, 3, -2, 0, 5, 5, 5, 5, -5, 5, 5, -5};
  for (std::size_t k = 0; k < commands.size(); ++k) {
    meter.command(static_cast<double>(k), 0, std::vector<double>{commands[k]});
    meter.command(static_cast<double>(k), 1, std::vector<double>{1});
    if (k == 8) {
      EXPECT_EQ(meter.statistics(0, 0).reversals, 3) << "-1, 3, -2 and 5 less the second 3";
      EXPECT_EQ(meter.statistics(0, 0).reversing_from, 3);
    }
  }
  EXPECT_EQ(meter.statistics(0, 0).reversals, 2) << "-5, 5 and -5 less the second 5";
  EXPECT_EQ(meter.statistics(0, 0).reversing_from, 12);
  EXPECT_EQ(meter.statistics(0, 1).reversals, 0);
}

TEST(Meter, WithoutAStepIsZero) {
  const std::vector<Scenario> lanes = metered(2, 1);
  const Meter meter(lanes);
  for (const JointStatistic& one : kJointStatistics) EXPECT_EQ(meter.statistics(0, 1).*one.member, 0) << one.name;
}

/// Three lanes of three joints are a block of eight entries and a block with one.
TEST(Meter, OfALaneIsThatOfTheLaneAlone) {
  constexpr std::size_t kLanes = 3;
  constexpr std::size_t kJoints = 3;
  const std::vector<Scenario> lanes = metered(kLanes, kJoints);
  Meter together(lanes);
  std::vector<Meter> alone;
  for (std::size_t l = 0; l < kLanes; ++l) alone.emplace_back(std::span(lanes).subspan(l, 1));
  std::mt19937_64 bits(5);
  std::uniform_real_distribution<double> number(-2, 2);
  MeterInput all(kLanes, kJoints);
  MeterInput one(1, kJoints);
  for (int step = 0; step < 40; ++step) {
    for (auto& values : all.of_joints) {
      for (double& value : values) value = number(bits);
    }
    for (double& value : all.saturation()) value = static_cast<double>(bits() % 3);
    for (double& value : all.available()) value = std::abs(value);
    all.instant = one.instant = step % 4 == 0;
    for (std::size_t l = 0; l < kLanes; ++l) {
      all.sum[l] = number(bits) + 1;
      all.share[l] = std::max(0.0, number(bits));
      all.measured[l] = bits() % 4 == 0 ? 0 : 1;
    }
    all.add_to(together, 0.1 * step);
    for (std::size_t l = 0; l < kLanes; ++l) {
      for (std::size_t k = 0; k < all.of_joints.size(); ++k) {
        for (std::size_t j = 0; j < kJoints; ++j) one.of_joints[k][j] = all.of_joints[k][j * kLanes + l];
      }
      one.sum[0] = all.sum[l];
      one.share[0] = all.share[l];
      one.measured[0] = all.measured[l];
      one.add_to(alone[l], 0.1 * step);
      if (step % 10 == 9) {
        EXPECT_EQ(ticked(together, l, kJoints), ticked(alone[l], 0, kJoints)) << l;
      }
    }
  }
  for (std::size_t l = 0; l < kLanes; ++l) {
    for (std::size_t j = 0; j < kJoints; ++j) {
      for (const JointStatistic& one_of : kJointStatistics)
        EXPECT_EQ(together.statistics(j, l).*one_of.member, alone[l].statistics(j, 0).*one_of.member) << one_of.name << j << l;
    }
  }
}

/// A step is extrapolated from its two halves. Each half has the weight 2 h/2, and the whole step is subtracted once.
TEST(Meter, TakesAnAuxiliaryPartOffSumsAndOutOfPeaks) {
  const std::vector<Scenario> lanes = metered(1, 1);
  Meter meter(lanes);
  MeterInput in(1, 1);
  const auto add = [&](double torque, double sum, double share) {
    in.torque() = {torque};
    in.setpoint() = {torque};
    in.sum = {sum};
    in.share = {share};
    in.add_to(meter, 0);
  };
  add(2, 0.5, 0.25);
  add(2, 0.5, 0.25);
  add(50, -0.5, 0);  // an auxiliary part, whose torque was never applied
  const JointStatistics of = meter.statistics(0, 0);
  EXPECT_EQ(of.torque_peak, 2);
  EXPECT_EQ(of.error_peak, 2);
  EXPECT_EQ(of.setpoint_outside, 1) << "all of the 0.5 s";
  EXPECT_EQ(of.torque_rms, 2) << "0.25 s + 0.25 s in 0.5 s";
}

TEST(Meter, AnInstantRaisesPeaksAndNothingElse) {
  const std::vector<Scenario> lanes = metered(1, 1);
  Meter meter(lanes);
  MeterInput in(1, 1);
  in.torque() = {3};
  in.current() = {2};
  in.saturation() = {1};
  in.power_in() = {9};
  in.setpoint() = {5};
  in.instant = true;
  in.add_to(meter, 0.125);
  in.instant = false;
  in.torque() = in.current() = in.setpoint() = in.power_in() = in.saturation() = {0};
  in.add_to(meter, 0.125);
  const JointStatistics of = meter.statistics(0, 0);
  EXPECT_EQ(of.torque_peak, 3);
  EXPECT_EQ(of.torque_peak_time, 0.125);
  EXPECT_EQ(of.current_peak, 2);
  EXPECT_EQ(of.error_peak, 5);
  for (double JointStatistics::*member :
       {&JointStatistics::torque_rms, &JointStatistics::current_rms, &JointStatistics::error_rms, &JointStatistics::electrical,
        &JointStatistics::saturated_voltage, &JointStatistics::setpoint_outside})
    EXPECT_EQ(of.*member, 0);
}

TEST(Meter, TicksHavePeaksSinceTheOneBeforeAndIntegralsFromTheStart) {
  const std::vector<Scenario> lanes = metered(2, 2);
  Meter meter(lanes);
  MeterInput in(2, 2);
  constexpr std::size_t kOne = 1 * 2 + 0;  // joint 1 of lane 0
  in.torque()[kOne] = -3;
  in.setpoint()[kOne] = 0.5;
  in.speed()[kOne] = -4;
  in.voltage()[kOne] = -6;
  in.current()[kOne] = -2;
  in.saturation()[kOne] = 2;
  in.available()[kOne] = 4;
  in.add_to(meter, 0);
  const std::vector<double> first = ticked(meter, 0, 2);
  EXPECT_EQ(std::vector(first.begin() + kTickColumns, first.end()),
            (std::vector<double>{3, 0.5, 2, 0.25 * 9, 0, 0.25, 4, 0.75, 0.25 * 4, 6, 2}));
  EXPECT_EQ(first[kTorquePeak], 0) << "joint 0";
  EXPECT_EQ(ticked(meter, 1, 2)[kTickColumns + kTorquePeak], 0) << "the other lane";
  in.torque()[kOne] = 1;
  in.speed()[kOne] = in.voltage()[kOne] = in.current()[kOne] = in.saturation()[kOne] = in.setpoint()[kOne] = 0;
  in.add_to(meter, 0.25);
  const std::vector<double> second = ticked(meter, 0, 2);
  EXPECT_EQ(std::vector(second.begin() + kTickColumns, second.end()),
            (std::vector<double>{1, 0, 0, 0.25 * 10, 0, 0.25, 0, 0.25, 0.25 * 4, 0, 0}));
}

TEST(Meter, APassiveHingeHasNoTrackingError) {
  std::vector<Scenario> lanes = metered(1, 1);
  Robot robot = *lanes[0].robot;
  robot.joints[0].passive.emplace();
  lanes[0].robot = std::make_shared<const Robot>(robot);
  Meter meter(lanes);
  MeterInput in(1, 1);
  in.angle() = {1.5};
  in.setpoint() = {9};
  in.add_to(meter, 0);
  const JointStatistics of = meter.statistics(0, 0);
  EXPECT_EQ(of.error_peak, 0);
  EXPECT_EQ(of.start_jump, 0);
  EXPECT_EQ(of.setpoint_outside, 0);
  EXPECT_EQ(of.range_worst, 0.5) << "but it is beyond its range";
  EXPECT_EQ(of.range_share, 1);
}

}  // namespace
}  // namespace gaitlab
