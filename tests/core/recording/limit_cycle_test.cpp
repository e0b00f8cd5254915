#include "core/recording/limit_cycle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/math/functions.h"

namespace gaitlab {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDt = 0.005;  // the default trace period, s

using Motion = std::function<double(double t)>;

double swing(double t, double period, double phase = 0) { return math::sin(2 * kPi * t / period + phase); }

std::vector<double> sample(const std::vector<Motion>& columns, double duration = 20, double dt = kDt) {
  std::vector<double> values;
  const long last = std::lround(duration / dt);
  for (long row = 0; row <= last; ++row) {
    for (const Motion& column : columns) values.push_back(column(static_cast<double>(row) * dt));
  }
  return values;
}

MotionCycle find(const std::vector<Motion>& columns, double duration = 20, double dt = kDt) {
  return find_limit_cycle(sample(columns, duration, dt), columns.size(), dt);
}

// Set point as in a trace: constant between control ticks. A row at a tick contains the value before the tick.
Motion held(const Motion& motion, double tick) {
  return [=](double t) { return motion(tick * std::max(0.0, std::ceil(t / tick - 1e-9) - 1)); };
}

// Motions of the sixteen joints of eight modules. Each joint leads its predecessor, and the amplitude grows from 0.
std::vector<Motion> chain(double period, double rate) {
  std::vector<Motion> columns;
  for (int joint = 0; joint < 16; ++joint) {
    const Motion angle = [=](double t) { return 0.6 * (1 - math::exp(-rate * t)) * swing(t, period, 1.2 * joint); };
    columns.push_back(angle);
    columns.push_back(held(angle, 0.015));
  }
  return columns;
}

TEST(LimitCycle, SineHasItsPeriodFromTheStart) {
  for (const double period : {0.05, 0.11, 0.5, 1.0, 3.9, 4.0, 4.0017, 2 * kPi, 9.5}) {
    SCOPED_TRACE(period);
    const MotionCycle cycle = find({[=](double t) { return 0.6 * swing(t, period, 0.3); }});
    EXPECT_TRUE(cycle.found);
    EXPECT_NEAR(cycle.period, period, 1e-3 * period);
    EXPECT_LT(cycle.error, 0.003);
    EXPECT_EQ(cycle.from, 0);
  }
}

TEST(LimitCycle, PeriodBetweenSamplesIsRefined) {
  const MotionCycle cycle = find({[](double t) { return 0.6 * swing(t, 1.2337); }});
  EXPECT_NEAR(cycle.period, 1.2337, 1e-5);
  EXPECT_LT(cycle.error, 1e-4);
}

TEST(LimitCycle, ChainSettles) {
  const std::vector<double> values = sample(chain(4, 2));
  ASSERT_EQ(values.size(), 4001U * 32U);
  const MotionCycle cycle = find_limit_cycle(values, 32, kDt);
  EXPECT_TRUE(cycle.found);
  EXPECT_NEAR(cycle.period, 4, 1e-3);
  EXPECT_GT(cycle.from, 0.5);
  EXPECT_LT(cycle.from, 2.0);
}

// The cost of the search is proportional to the number of rows, because the number of lags and points is limited. A search over
// all lags would compare a hundred times as many pairs for ten times the rows.
TEST(LimitCycle, CostGrowsLinearly) {
  const std::size_t pairs = find_limit_cycle(sample(chain(4, 2)), 32, kDt).pairs;
  const std::size_t more = find_limit_cycle(sample(chain(4, 2), 200), 32, kDt).pairs;
  EXPECT_GT(pairs, 4001U * 32U);  // each sample at least once
  EXPECT_LT(more, 11 * pairs);    // a tenth for windows that are not a whole number of strides
}

TEST(LimitCycle, FromIsTheEarliestWindowThatHoldsOn) {
  // One of two joints has a transient. The test evaluates the definition of the limit cycle with a period of whole samples.
  const std::vector<Motion> columns = {[](double t) { return 0.6 * swing(t, 2); },
                                       [](double t) { return 0.3 * swing(t, 2, 1) + 0.5 * math::exp(-t) * swing(t, 0.7); }};
  const MotionCycle cycle = find(columns);
  ASSERT_TRUE(cycle.found);
  ASSERT_NEAR(cycle.period, 2, 1e-4);
  const auto error_at = [&](double from) {
    double worst = 0;
    for (const std::size_t c : {0U, 1U}) {
      double sum = 0;
      for (int k = 0; k < 400; ++k) {
        const double t = from + k * kDt;
        sum += std::pow(columns[c](t + 2) - columns[c](t), 2);
      }
      worst = std::max(worst, std::sqrt(sum / 400) / (c == 0 ? 0.6 : 0.3));
    }
    return worst;
  };
  EXPECT_NEAR(cycle.error, error_at(16), 2e-4);
  EXPECT_LT(error_at(cycle.from + 0.02), 0.02);
  EXPECT_GT(error_at(cycle.from - 0.02), 0.02);
}

TEST(LimitCycle, ALateDisturbanceMovesFrom) {
  const MotionCycle cycle = find({[](double t) { return 0.6 * swing(t, 2) + (t > 9 && t < 9.3 ? 0.3 : 0.0); }});
  ASSERT_TRUE(cycle.found);
  EXPECT_NEAR(cycle.from, 9.3, 0.02);
}

TEST(LimitCycle, HeldSetPointsDoNotHideThePeriod) {
  for (const double period : {0.5, 1.0, 4.0}) {  // no multiples of 15 ms; control ticks repeat only after three periods
    const Motion angle = [=](double t) { return 0.6 * swing(t, period); };
    const MotionCycle cycle = find({held(angle, 0.015)});
    EXPECT_TRUE(cycle.found);
    EXPECT_NEAR(cycle.period, period, 2e-3 * period);
  }
}

TEST(LimitCycle, SquareWavesArePeriodicToo) {
  const MotionCycle cycle = find({[](double t) { return std::fmod(t, 2) < 0.7 ? 0.4 : -0.4; }});
  EXPECT_TRUE(cycle.found);
  EXPECT_NEAR(cycle.period, 2, 1e-2);
}

TEST(LimitCycle, HarmonicsAndSubharmonics) {
  const auto period = [](const std::vector<Motion>& columns) {
    const MotionCycle cycle = find(columns);
    return cycle.found ? cycle.period : 0.0;
  };
  EXPECT_NEAR(period({[](double t) { return swing(t, 4) + 0.7 * swing(t, 2, 1) + 0.3 * swing(t, 0.8); }}), 4, 1e-3);
  EXPECT_NEAR(period({[](double t) { return swing(t, 2) + 0.05 * swing(t, 4); }}), 4, 1e-3);  // at 2 s the error is 7 %
  EXPECT_NEAR(period({[](double t) { return swing(t, 4) + 0.1 * swing(t, 0.2); }}), 4, 1e-3);
  // If joints have different frequencies, the result is the common period.
  EXPECT_NEAR(period({[](double t) { return swing(t, 2); }, [](double t) { return swing(t, 3); }}), 6, 1e-3);
  EXPECT_NEAR(period({[](double t) { return swing(t, 4); }, [](double t) { return 0.1 * swing(t, 0.4); }}), 4, 1e-3);
  // Two tripods in antiphase exchange their motions after half a period, but each joint repeats only after a whole period.
  EXPECT_NEAR(period({[](double t) { return swing(t, 2); }, [](double t) { return swing(t + 1, 2); }}), 2, 1e-3);
}

TEST(LimitCycle, JointsThatHoldDoNotCount) {
  std::mt19937 random(1);
  std::normal_distribution<double> tremble(0, 5e-6);
  const MotionCycle cycle = find(
      {[](double) { return 0.2; }, [](double t) { return 0.6 * swing(t, 2); }, [&](double) { return -0.1 + tremble(random); }});
  EXPECT_TRUE(cycle.found);
  EXPECT_NEAR(cycle.period, 2, 1e-3);
}

TEST(LimitCycle, LittleNoiseIsBorneMuchIsNot) {
  for (const double sigma : {0.002, 0.03}) {  // noise relative to the amplitude; the error is sqrt(2) sigma
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.6 * sigma);
    const MotionCycle cycle = find({[&](double t) { return 0.6 * swing(t, 4) + noise(random); }});
    EXPECT_EQ(cycle.found, sigma < 0.01);
    EXPECT_NEAR(cycle.error, std::sqrt(2.0) * sigma, 0.3 * sigma);
    EXPECT_NEAR(cycle.period, 4, 0.01);
  }
}

TEST(LimitCycle, NoiseAloneChirpsAndDecaysAreNone) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.1);
  EXPECT_FALSE(find({[&](double) { return noise(random); }}).found);
  EXPECT_FALSE(find({[](double t) { return swing(t * (1 + 0.05 * t), 4); }}).found);
  EXPECT_FALSE(find({[](double t) { return math::exp(-0.1 * t) * swing(t, 2); }}).found);
  EXPECT_FALSE(find({[](double t) { return math::exp(-2 * t) * swing(t, 2); }}).found);  // the motion decays to rest
  EXPECT_FALSE(find({[](double t) { return 0.1 * t; }}).found);
  EXPECT_FALSE(find({[](double t) { return 0.1 * t + 0.3 * swing(t, 2); }}).found);
}

TEST(LimitCycle, StandingStillIsNone) {
  const MotionCycle cycle = find({[](double) { return 0.3; }, [](double t) { return 1e-4 * swing(t, 1); }});
  EXPECT_FALSE(cycle.found);
  EXPECT_EQ(cycle.period, 0);
  EXPECT_EQ(cycle.error, 1);
}

TEST(LimitCycle, NeedsTwoPeriods) {
  for (const double period : {9.0, 9.99, 10.0}) {
    const MotionCycle cycle = find({[=](double t) { return swing(t, period, 0.4); }});
    EXPECT_TRUE(cycle.found) << period;
    EXPECT_NEAR(cycle.period, period, 1e-3);
  }
  for (const double period : {10.02, 10.1, 11.0, 15.0, 40.0})
    EXPECT_FALSE(find({[=](double t) { return swing(t, period, 0.4); }}).found) << period;
}

TEST(LimitCycle, CoarseAndLongSeries) {
  const MotionCycle coarse = find({[](double t) { return swing(t, 1.03); }}, 20, 0.1);
  EXPECT_TRUE(coarse.found);
  EXPECT_NEAR(coarse.period, 1.03, 1e-3);
  const MotionCycle slow = find({[](double t) { return swing(t, 400); }}, 1000, 0.005);
  EXPECT_TRUE(slow.found);
  EXPECT_NEAR(slow.period, 400, 0.01);
}

TEST(LimitCycle, BadInputIsNone) {
  EXPECT_FALSE(find_limit_cycle({}, 0, kDt).found);
  EXPECT_FALSE(find_limit_cycle({}, 3, kDt).found);
  EXPECT_FALSE(find({[](double t) { return swing(t, 0.02); }}, 0.05).found);
  std::vector<double> values = sample({[](double t) { return swing(t, 2); }});
  values[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(find_limit_cycle(values, 1, kDt).found);
}

TEST(LimitCycle, SameInputSameBits) {
  const MotionCycle a = find(chain(1.37, 2));
  const MotionCycle b = find(chain(1.37, 2));
  EXPECT_EQ(a.period, b.period);
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.from, b.from);
}

}  // namespace
}  // namespace gaitlab
