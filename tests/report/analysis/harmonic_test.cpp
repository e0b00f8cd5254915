#include "report/analysis/harmonic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gaitlab::test {
namespace {

TEST(FirstHarmonic, IsThatOfASineWithAMean) {
  // The period is not a multiple of the time between rows. The window contains the last two periods.
  Trace table;
  table.columns = {{"t", "s", ""}, {"x", "rad", ""}, {"y", "rad", ""}};
  const double period = 1.2345;
  for (int k = 0; k <= 600; ++k) {
    const double t = 0.005 * k;
    const double turn = 2 * std::numbers::pi * t / period;
    for (const double value : {t, 0.3 + 0.5 * std::sin(turn + 0.7), -0.2 * std::sin(turn)}) table.values.push_back(value);
  }
  const MotionCycle cycle{.found = true, .from = 0.1, .period = period, .error = 0};
  const auto found = report::first_harmonics(cycle, Series(table, 0), {Series(table, 1), Series(table, 2)});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].amplitude, 0.5, 1e-12) << "rounding of some hundred terms";
  EXPECT_NEAR(found[0].phase, 0.7, 1e-12);
  EXPECT_NEAR(found[1].amplitude, 0.2, 1e-12);
  EXPECT_NEAR(std::abs(found[1].phase), std::numbers::pi, 1e-12);
  EXPECT_TRUE(report::first_harmonics({}, Series(table, 0), {Series(table, 1)}).empty());
}

}  // namespace
}  // namespace gaitlab::test
