// Tests of the times at which a rollout computes commands, records rows and ends: at whole steps, or within steps if the
// integrator chooses them.
#include "core/simulation/lane_clock.h"

#include <gtest/gtest.h>

namespace gaitlab {
namespace {

Scenario scenario(double step, double duration, double period, bool adaptive) {
  Scenario s;
  s.physics.step = step;
  s.physics.adaptive_step = adaptive;
  s.duration = duration;
  s.trace.period = period;
  s.control_period = 0.015;
  return s;
}

/// Times of all rows, s; the last is the end of the run.
std::vector<double> rows(const Scenario& s) {
  const LaneClock clock(s);
  std::vector<double> times;
  for (std::int64_t step = 0; step < clock.steps(); ++step) {
    const double start = static_cast<double>(step) * s.physics.step;
    if (clock.records(step)) times.push_back(start);
    for (double at = clock.row_within(step, 0); std::isfinite(at); at = clock.row_within(step, at)) {
      times.push_back(start + at);
      if (clock.ends_within(step, at)) return times;
    }
  }
  EXPECT_TRUE(clock.ends(clock.steps()));
  EXPECT_TRUE(clock.records(clock.steps()));
  times.push_back(static_cast<double>(clock.steps()) * s.physics.step);
  return times;
}

TEST(LaneClock, RowsAreMultiplesOfThePeriodAndTheEnd) {
  for (const double duration : {0.3, 0.3127, 0.0031, 0.005, 20.0, 20.0001}) {
    for (const double period : {5e-3, 1e-3, 7e-3, 0.0113, 1.0 / 3, 2.7e-4, 0.3127, 100.0}) {
      const std::vector<double> times = rows(scenario(5e-3, duration, period, true));
      const double whole = std::ceil(duration / period - 1e-9);
      ASSERT_EQ(times.size(), static_cast<std::size_t>(whole) + 1) << duration << " " << period;
      EXPECT_NEAR(times.back(), duration, 1e-12);
      for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        EXPECT_NEAR(times[k], static_cast<double>(k) * period, 1e-12);  // exact to 1 ps
      }
    }
  }
}

TEST(LaneClock, TimesOfOneRowAreTheSameBitsOfAnyPeriod) {
  const std::vector<double> fine = rows(scenario(5e-3, 20, 1e-3, true));
  const std::vector<double> rare = rows(scenario(5e-3, 20, 7e-3, true));
  for (std::size_t k = 0; k + 1 < rare.size(); ++k) EXPECT_EQ(rare[k], fine[7 * k]) << k;
}

TEST(LaneClock, NothingIsWithinAStepThatWasGiven) {
  const LaneClock clock(scenario(1e-3, 0.3, 5e-3, false));
  EXPECT_EQ(clock.steps(), 300);
  for (std::int64_t step = 0; step <= 300; ++step) {
    EXPECT_EQ(clock.records(step), step % 5 == 0) << step;
    EXPECT_EQ(clock.commands(step), step % 15 == 0 && step < 300) << step;
    EXPECT_EQ(clock.ends(step), step == 300);
  }
  // 1/40000 s is not exact in binary. The number of steps is rounded once, so that errors do not accumulate.
  EXPECT_EQ(LaneClock(scenario(2.5e-5, 20, 5e-3, false)).steps(), 800000);
}

/// Without trace rows only the end of the run is recorded, at a step or within a step.
TEST(LaneClock, RecordsNothingButTheEnd) {
  const LaneClock at_step(scenario(5e-4, 0.15, 2.5e-3, false), false);
  for (std::int64_t step = 0; step <= 300; ++step) EXPECT_EQ(at_step.records(step), step == 300) << step;
  const LaneClock within(scenario(5e-3, 0.0517, 2.5e-3, true), false);
  for (std::int64_t step = 0; step <= 11; ++step) EXPECT_FALSE(within.records(step)) << step;
  for (std::int64_t step = 0; step < 10; ++step) EXPECT_TRUE(std::isinf(within.row_within(step, 0))) << step;
  EXPECT_NEAR(within.row_within(10, 0), 1.7e-3, 1e-12);  // exact to 1 ps
  EXPECT_TRUE(within.ends_within(10, within.row_within(10, 0)));
  EXPECT_TRUE(std::isinf(within.row_within(10, within.row_within(10, 0))));
}

}  // namespace
}  // namespace gaitlab
