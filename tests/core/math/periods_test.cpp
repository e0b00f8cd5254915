// Number of steps in periods that are whole multiples of the step up to rounding errors.
#include "core/math/periods.h"

#include <gtest/gtest.h>

namespace gaitlab::math {
namespace {

TEST(WholeSteps, AreThoseWithinATolerance) {
  EXPECT_EQ(whole_steps(0.015, 2.5e-5), 600);
  EXPECT_EQ(whole_steps(20, 2.5e-5), 800000);
  EXPECT_EQ(whole_steps(0.015, 4e-5), 375);
  EXPECT_EQ(whole_steps(0.3, 0.1), 3);  // the quotient is 2.9999999999999996
  EXPECT_EQ(whole_steps(0.015, 7e-5), 0);
  EXPECT_EQ(whole_steps(0.015 * (1 + 1e-8), 2.5e-5), 0);
  EXPECT_EQ(whole_steps(0.015 * (1 + 1e-10), 2.5e-5), 600);
  EXPECT_EQ(whole_steps(1e-5, 2.5e-5), 0);
}

TEST(StepsIn, AreTheNearestWholeNumber) {
  EXPECT_EQ(steps_in(0.3, 0.1), 3);  // the quotient is 2.9999999999999996
  EXPECT_EQ(steps_in(0.015, 2.5e-5), 600);
  EXPECT_EQ(steps_in(0.34, 0.1), 3);
}

}  // namespace
}  // namespace gaitlab::math
