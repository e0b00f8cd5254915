// Tests of the voltage of a bus: closed forms, and a search by halves over all voltages.
#include "core/simulation/supply.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/random.h"

namespace gaitlab::test {
namespace {

/// Motor with R and k = Kt n = Ks n, limited by the bus alone.
DcMotor motor(double R, double k = 1, double i_max = 1e9) {
  DcMotor made{R, k, k, 1, 1, 1e9, i_max};
  return made;
}

std::vector<BusMotor> equal(std::size_t count, const BusMotor& one) { return std::vector<BusMotor>(count, one); }

// Rounding of sums of 30 powers, and the end of the search at 1e-13 of 7.4 V.
constexpr double kRounding = 1e-11;

TEST(Bus, StalledMotorsUnderVoltsDrawConstantPower) {
  const DcMotor own = motor(4.3);
  for (const std::size_t count : {1U, 30U}) {
    const Supply supply{.voltage = 7.4, .resistance = 0.1};
    const double u = 3;
    const double power = static_cast<double>(count) * u * u / 4.3;
    const BusState bus = solve(supply, equal(count, {&own, 0, u}));
    EXPECT_NEAR(bus.voltage, (7.4 + std::sqrt(7.4 * 7.4 - 4 * 0.1 * power)) / 2, kRounding) << count;
    EXPECT_NEAR(bus.current, power / bus.voltage, kRounding);
    EXPECT_TRUE(bus.held);
  }
}

TEST(Bus, StalledMotorsAtTheSupplyDivideTheVoltage) {
  // Solved with the voltage of the last tick, 22 such motors at 6.1 V alternate between 6.10 and 3.55 V.
  const DcMotor own = motor(4.3);
  for (const std::size_t count : {1U, 22U, 30U, 300U}) {
    const Supply supply{.voltage = 6.1, .resistance = 0.15};
    const double expected = 6.1 / (1 + 0.15 * static_cast<double>(count) / 4.3);
    EXPECT_NEAR(solve(supply, equal(count, {&own, 0, 100})).voltage, expected, kRounding) << count;
    EXPECT_NEAR(solve(supply, equal(count, {&own, 0, 1, true})).voltage, expected, kRounding) << count;
    EXPECT_NEAR(solve(supply, equal(count, {&own, 0, -7, true, 1})).voltage, expected, kRounding) << count;
  }
}

TEST(Bus, DutiesAreLinear) {
  // I = sum d (d V - k w) / R
  const DcMotor one = motor(2, 0.5);
  const DcMotor two = motor(5, 0.8);
  const Supply supply{.voltage = 12, .resistance = 0.3};
  const std::vector<BusMotor> motors{{&one, 3, 0.7, true}, {&two, -2, -0.9, true}, {&two, 1, 0.1, true}};
  double conductance = 0;
  double back = 0;
  for (const BusMotor& m : motors) {
    conductance += m.command * m.command / m.motor->R;
    back += m.command * m.motor->Ks * m.speed / m.motor->R;
  }
  const BusState bus = solve(supply, motors);
  EXPECT_NEAR(bus.voltage, (12 + 0.3 * back) / (1 + 0.3 * conductance), kRounding);
  EXPECT_NEAR(bus.current, conductance * bus.voltage - back, kRounding);
}

TEST(Bus, MotorsThatBrakeFeedTheirNeighboursFirst) {
  const DcMotor own = motor(2, 0.5);
  Supply supply{.voltage = 6, .resistance = 0.5};
  const BusMotor brakes{&own, 20, 0.5, true};  // (0.5 V - 10) / 2 < 0
  const BusMotor drives{&own, 0, 1, true};
  EXPECT_EQ(solve(supply, {brakes}).voltage, 6);
  EXPECT_EQ(solve(supply, {brakes}).current, 0);
  EXPECT_NEAR(solve(supply, {brakes, drives}).voltage, (6 + 0.5 * 0.5 * 10 / 2) / (1 + 0.5 * (0.25 + 1) / 2), kRounding);
  supply.regenerates = true;
  const BusState fed = solve(supply, {brakes});
  EXPECT_NEAR(fed.voltage, (6 + 0.5 * 0.5 * 10 / 2) / (1 + 0.5 * 0.25 / 2), kRounding);
  EXPECT_LT(fed.current, 0);
  EXPECT_TRUE(fed.held);
}

TEST(Bus, IsTheLargestSolution) {
  // The oracle looks at 4000 voltages from above and halves the first change of sign.
  std::uint64_t seed = 7;
  const auto draw = [&](double low, double high) { return low + (high - low) * math::uniform({seed++}); };
  int sagging = 0;
  int broken = 0;
  for (int run = 0; run < 300; ++run) {
    std::vector<DcMotor> motors;
    for (int j = 0; j < 6; ++j) motors.push_back(motor(draw(1, 8), draw(0.2, 1.5), draw(0, 1) < 0.5 ? draw(0.2, 2) : 1e9));
    std::vector<BusMotor> all;
    for (const DcMotor& one : motors) {
      const bool duty = draw(0, 1) < 0.5;
      all.push_back({&one, draw(-6, 6), duty ? draw(-1.3, 1.3) : draw(-9, 9), duty, duty ? draw(0.5, 1) : 1});
    }
    const Supply supply{.voltage = draw(5, 9), .resistance = draw(0.02, 1.5)};
    const auto beyond = [&](double V) {  // V - (V0 - r I)
      double power = 0;
      for (const BusMotor& one : all) {
        const double most = (one.duty ? one.most : 1) * V;
        power += (*one.motor)(std::clamp(one.duty ? one.command * V : one.command, -most, most), one.speed).drawn;
      }
      return V - supply.voltage + supply.resistance * std::fmax(0, power) / V;
    };
    constexpr int kSteps = 4000;
    double high = supply.voltage;
    double low = 0;
    for (int k = kSteps - 1; k > 0 && low == 0; --k) {
      const double at = supply.voltage * k / kSteps;
      (beyond(at) > 0 ? high : low) = at;
    }
    for (int k = 0; low > 0 && k < 80; ++k) {
      const double middle = (low + high) / 2;
      (beyond(middle) > 0 ? high : low) = middle;
    }
    const BusState bus = solve(supply, all);
    if (beyond(supply.voltage) <= 0) {
      EXPECT_EQ(bus.voltage, supply.voltage);
    } else if (low > 0) {
      EXPECT_NEAR(bus.voltage, low, 1e-10) << run;
      EXPECT_TRUE(bus.held);
      ++sagging;
    } else {
      EXPECT_FALSE(bus.held) << run;
      EXPECT_EQ(bus.voltage, supply.voltage / 2);
      ++broken;
    }
  }
  EXPECT_GT(sagging, 200);
  EXPECT_GT(broken, 0);
}

}  // namespace
}  // namespace gaitlab::test
