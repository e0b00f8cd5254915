// Tests of the analytical solutions that other tests use (tests/oracles), by derivatives, invariants and tabulated values.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracles/blocks.h"
#include "tests/oracles/double_pendulum.h"
#include "tests/oracles/drives.h"
#include "tests/oracles/pendulum.h"
#include "tests/oracles/tops.h"

namespace gaitlab::oracle {
namespace {

constexpr double kOracleRounding = 1e-13;  // rounding errors of some hundred operations with numbers of 1 to 10

/// Derivative by a central difference of order 4. Its error h^4 f^(5) / 30 and rounding error 1e-16 / h are together 1e-11 for
/// h = 1e-3 and f of size 1.
template <class F>
double derivative(const F& f, double t) {
  const double h = 1e-3;
  return (f(t - 2 * h) - 8 * f(t - h) + 8 * f(t + h) - f(t + 2 * h)) / (12 * h);
}

TEST(Oracle, EllipticFunctions) {
  EXPECT_NEAR(elliptic_k(0.5), 1.6857503548125961, 1e-15);  // Abramowitz and Stegun, table 17.1, m = 0.25
  for (const double k : {0.01, 0.5, 0.9, 0.9999}) {
    EXPECT_NEAR(elliptic_k(k), std::comp_ellint_1(k), 1e-13 * elliptic_k(k));
    for (const double u : {0.1, 0.7, 1.3}) {
      const Jacobi j = jacobi(u, k);
      EXPECT_NEAR(std::ellint_1(k, std::atan2(j.sn, j.cn)), u, kOracleRounding) << k;
      EXPECT_NEAR(j.dn * j.dn + k * k * j.sn * j.sn, 1, kOracleRounding);
      EXPECT_NEAR(derivative([&](double x) { return jacobi(x, k).sn; }, u), j.cn * j.dn, 1e-10) << k;
    }
    EXPECT_NEAR(jacobi(5 * elliptic_k(k), k).sn, 1, kOracleRounding) << "a period later";
  }
}

TEST(Oracle, ExtrapolationReachesRounding) {
  const auto swing = [](const std::array<double, 2>& x) { return std::array<double, 2>{x[1], -x[0]}; };
  const auto end = integrate(swing, std::array<double, 2>{1, 0}, 10, 20);
  EXPECT_NEAR(end[0], std::cos(10), kOracleRounding);
  EXPECT_NEAR(end[1], -std::sin(10), kOracleRounding);
}

TEST(Oracle, PendulumObeysItsEquation) {
  const Pendulum pendulum(3, 2.5);
  EXPECT_NEAR(pendulum.angle(0), 2.5, kOracleRounding);
  EXPECT_NEAR(pendulum.angle(pendulum.period()), 2.5, 1e-12);
  EXPECT_NEAR(Pendulum(3, 1e-4).period(), 2 * std::numbers::pi / 3, 2e-9);  // small swings are longer by amplitude^2 / 16
  for (const double t : {0.2, 0.9, 1.7}) {
    EXPECT_NEAR(derivative([&](double x) { return pendulum.angle(x); }, t), pendulum.speed(t), 1e-8);
    EXPECT_NEAR(derivative([&](double x) { return pendulum.speed(x); }, t), -9 * std::sin(pendulum.angle(t)), 1e-8);
  }
}

TEST(Oracle, DoublePendulumKeepsItsEnergyAndSwingsInItsModes) {
  const DoublePendulum two;
  const DoublePendulum::State start{1, 2, 0.5, -1};
  EXPECT_NEAR(two.energy(two.at(5, start)), two.energy(start), 1e-12);
  // For small swings det([4/3, 1/2; 1/2, 1/3] w^2 - g/l [3/2, 0; 0, 1/2]) = 0, hence w^2 = (3 +- 6/sqrt(7)) g/l.
  for (const double sign : {-1.0, 1.0}) {
    const double square = (3 + sign * 6 / std::sqrt(7.0)) * two.g;
    const double ratio = (1.5 * two.g - 4.0 / 3 * square) / (square / 2);  // theta2 / theta1 of the mode
    const DoublePendulum::State mode{1e-6, 1e-6 * ratio, 0, 0};
    const DoublePendulum::State end = two.at(std::numbers::pi / std::sqrt(square), mode);
    EXPECT_NEAR(end[0] / mode[0], -1, 1e-9);  // nonlinear terms are as small as the squared angle
    EXPECT_NEAR(end[1] / mode[1], -1, 1e-9);
  }
}

TEST(Oracle, FreeTopObeysEulersEquations) {
  const FreeTop top({1, 2, 3}, 1.9, 1.3);
  for (const double t : {0.0, 0.4, 3.1}) {
    const auto expected = top.acceleration(top(t));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(derivative([&](double x) { return top(x)[i]; }, t), expected[i], 1e-8) << i;
  }
  EXPECT_THROW(FreeTop({1, 2, 3}, 3, 0.1), std::invalid_argument);
}

TEST(Oracle, HeavyTopHangsTogether) {
  const HeavyTop top{0.3, 0.1, 2};
  EXPECT_NEAR(top.lean(0.7, 1.5, top.spin_for(1.5, 0.7)), 0, kOracleRounding);
  // The energy at the turning point equals that at the start: (A W^2 sin^2 - 2 mgl (cos theta0 - cos theta)) / 2 = 0. The
  // precession rate W follows from the angular momentum about the vertical.
  const double w3 = 30;
  const double end = top.turns_back(0.7, w3);
  const double W = top.C * w3 * (std::cos(0.7) - std::cos(end)) / (top.A * std::sin(end) * std::sin(end));
  EXPECT_GT(end, 0.7);
  EXPECT_NEAR(top.A * W * W * std::sin(end) * std::sin(end) / 2, top.mgl * (std::cos(0.7) - std::cos(end)), 1e-12);
}

TEST(Oracle, Blocks) {
  const SlidingBlock block{0.8, 9.81, 0.01};
  // The distance is the integral of the speed, by Simpson's rule on 20 000 intervals. The kink at v_lim is between two
  // intervals.
  double way = 0;
  const double h = 1e-5;
  for (int i = 0; i < 20000; ++i) {
    const double t = i * h;
    way += h / 6 * (block.speed(0.9, t) + 4 * block.speed(0.9, t + h / 2) + block.speed(0.9, t + h));
  }
  EXPECT_NEAR(way, block.stops_after(0.9), 1e-9);
  EXPECT_NEAR(block.creeps(std::atan(0.8)), 0.01, 1e-15);  // the speed on the steepest slope is v_lim
  const StandingBlock standing{2, 4, 1e4, 50};
  const auto height = [&](double t) { return standing.height(1, t); };
  const auto speed = [&](double t) { return derivative(height, t); };
  // The tolerance is for the errors (h w)^4 w / 30 of two differences of an oscillation at 140 rad/s with h = 1e-3.
  EXPECT_NEAR(derivative(speed, 0.03) / (standing.n * standing.kn / standing.m),
              -height(0.03) - standing.cd / standing.kn * speed(0.03), 2e-4);
  EXPECT_NEAR(standing_sink(2, 10, 4, 1e4), 5e-4, 1e-18);
  // The reference for the bounce is the integral of p'' = -K/m p (1 + a p'). Newton's method finds the time at which p is 0
  // again.
  const auto impact = [](const std::array<double, 2>& x) { return std::array<double, 2>{x[1], -100 * x[0] * (1 + 5 * x[1])}; };
  double t = 0.3;
  std::array<double, 2> x{};
  for (int i = 0; i < 20; ++i) {
    x = integrate(impact, std::array<double, 2>{0, 0.1}, t, 40);
    t -= x[0] / x[1];
  }
  EXPECT_NEAR(-x[1], bounces_with(0.1, 100, 500), 1e-12);
  EXPECT_NEAR(bounces_with(0.1, 100, 1e-3), 0.1, 1e-6);  // with almost no damping the speed is preserved
}

TEST(Oracle, MotorSpinUpObeysItsEquation) {
  const MotorSpinUp motor{4.3, 0.00395, 0.00395, 594, 0.7, 1.2, 7.4, 0.05};
  for (const double t : {0.01, 0.05, 0.1}) {
    const double current = std::fmin(motor.i_max, (motor.u - motor.Ks * motor.n * motor.speed(t)) / motor.R);
    EXPECT_NEAR(motor.J * derivative([&](double x) { return motor.speed(x); }, t), motor.eta * motor.Kt * current * motor.n,
                1e-7);
  }
  EXPECT_LT(motor.limited_until(), 0.05);
  EXPECT_GT(motor.limited_until(), 0.01);
}

TEST(Oracle, StopBounceObeysItsEquation) {
  const StopBounce stop{0.05, 50, 0.5};
  const auto pushed = [&](const std::array<double, 2>& x) {
    return std::array<double, 2>{x[1], -(stop.ks * x[0] + stop.cs * x[1]) / stop.J};
  };
  const auto end = integrate(pushed, std::array<double, 2>{0, 2}, stop.lasts(), 10);
  EXPECT_NEAR(end[0], stop.at(stop.lasts(), 2)[0], kOracleRounding);
  EXPECT_NEAR(end[1], stop.at(stop.lasts(), 2)[1], kOracleRounding);
  EXPECT_NEAR(stop.ks * end[0] + stop.cs * end[1], 0, 1e-11);
  EXPECT_LT(end[1], 0);
  EXPECT_GT(end[0], 0);
}

TEST(Oracle, PidByHand) {
  // Values computed by hand for Kp = 2, Ki = 4, Kd = 1, N = 8, Ts = 1/8, hence Ki Ts = 1/2 and Kd + N Ts = 2:
  //   e     P     I                 D                          u
  //   1     2     0                 0                          2
  //   1/2   1     1/2               -8/2 / 2 = -2             -1/2
  //   1/2   1     1/2 + 1/4 = 3/4   -2 / 2 = -1                3/4
  //   -1   -2     3/4 + 1/4 = 1     (-1 - 12) / 2 = -13/2     -15/2
  TextbookPid pid(2, 4, 1, 8, 0.125);
  EXPECT_EQ(pid(1), 2);
  EXPECT_EQ(pid(0.5), -0.5);
  EXPECT_EQ(pid(0.5), 0.75);
  EXPECT_EQ(pid(-1), -7.5);
}

TEST(Oracle, PidSumsAreThePidByHand) {
  // First the values of the test above, without a limit. With a limit of 1, the commands marked `held` exceed the limit:
  //   e     P     I                 u
  //   1     2     0                 2      held
  //  -1/4  -1/2   0                -1/2
  //  -2    -4     -1/8             -33/8   held
  //   3     6     -1/8              47/8   held
  //  -1    -2     -1/8             -17/8
  PidSums pid(2, 4, 1, 8, 0.125, 1e9);
  EXPECT_EQ(pid(1), 2);
  EXPECT_EQ(pid(0.5), -0.5);
  EXPECT_EQ(pid(0.5), 0.75);
  EXPECT_EQ(pid(-1), -7.5);
  PidSums limited(2, 4, 0, 8, 0.125, 1);
  EXPECT_EQ(limited(1), 2);
  EXPECT_EQ(limited(-0.25), -0.5);
  EXPECT_EQ(limited(-2), -4.125);
  EXPECT_EQ(limited(3), 5.875);
  EXPECT_EQ(limited(-1), -2.125);
  EXPECT_TRUE(limited.held(0));
  EXPECT_FALSE(limited.held(1));
}

TEST(Oracle, PhasePairObeysItsEquation) {
  const PhasePair pair{2, 1.2};
  EXPECT_NEAR(pair.lag(0), 0, 1e-15);
  EXPECT_NEAR(pair.lag(30), pair.locked(), 1e-15);
  for (const double t : {0.1, 0.5, 2.0})
    EXPECT_NEAR(derivative([&](double x) { return pair.lag(x); }, t), 1.2 - 2 * std::sin(pair.lag(t)), 1e-9);
  EXPECT_NEAR(std::log((pair.locked() - pair.lag(10)) / (pair.locked() - pair.lag(10.5))) / 0.5, pair.decay(), 1e-5);
}

}  // namespace
}  // namespace gaitlab::oracle
