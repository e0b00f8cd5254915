// The Runge-Kutta step agrees with closed forms and has order 4.
#include "core/math/runge_kutta.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gaitlab::math {
namespace {

using In = std::span<const double>;
using Out = std::span<double>;

/// Error at t = 1 of the solution of x' = x, x(0) = 1, with n steps.
template <class Sum>
double error_of_growth(int n, const Sum& sum) {
  RungeKutta method(1);
  double x = 1;
  for (int i = 0; i < n; ++i) {
    method.step(
        {&x, 1}, 1.0 / n, [](double, In at, Out out) { out[0] = at[0]; }, sum);
  }
  return std::abs(x - std::exp(1.0));
}

TEST(RungeKuttaStep, IsOfOrder4) {
  // The tolerance is for the next term of the error, of order 5, which is 3 % of the error with 20 steps.
  EXPECT_NEAR(error_of_growth(20, RungeKutta::paired) / error_of_growth(40, RungeKutta::paired), 16, 0.8);
  EXPECT_NEAR(error_of_growth(20, RungeKutta::in_order), error_of_growth(20, RungeKutta::paired), 1e-14) << "rounding of e";
}

/// The step is exact for polynomials of degree 3 in t, as Simpson's rule is.
TEST(RungeKuttaStep, IntegratesCubicsOfTimeExactly) {
  RungeKutta method(2);
  std::array<double, 2> x{1, 0};
  method.step(
      x, 2.0,
      [](double reach, In, Out out) {
        const double t = 2 * reach;
        out[0] = 3 * t * t;
        out[1] = 4 * t * t * t;
      },
      RungeKutta::paired);
  EXPECT_DOUBLE_EQ(x[0], 1 + 8);
  EXPECT_DOUBLE_EQ(x[1], 16);
}

}  // namespace
}  // namespace gaitlab::math
