// Double pendulum of two uniform rods, by Lagrange's equations in the angles from the vertical.
#pragma once
#include <array>
#include <cmath>

#include "tests/oracles/extrapolation.h"

namespace gaitlab::oracle {

/// Two rods of mass m and length l each, hinged at their ends. The state is the angles of rods 1 and 2 from the vertical and
/// their rates, rad and rad/s.
struct DoublePendulum {
  using State = std::array<double, 4>;
  double m = 1, l = 1, g = 9.81;

  [[nodiscard]] State rate(const State& x) const {
    // With d = theta1 - theta2, divided by m l^2:
    //   4/3 theta1'' + 1/2 cos d theta2'' = -1/2 sin d theta2'^2 - 3/2 g/l sin theta1
    //   1/2 cos d theta1'' + 1/3 theta2'' =  1/2 sin d theta1'^2 - 1/2 g/l sin theta2
    const double c = std::cos(x[0] - x[1]) / 2;
    const double s = std::sin(x[0] - x[1]) / 2;
    const double f1 = -s * x[3] * x[3] - 1.5 * g / l * std::sin(x[0]);
    const double f2 = s * x[2] * x[2] - 0.5 * g / l * std::sin(x[1]);
    const double determinant = 4.0 / 9 - c * c;
    return {x[2], x[3], (f1 / 3 - c * f2) / determinant, (4.0 / 3 * f2 - c * f1) / determinant};
  }

  [[nodiscard]] double energy(const State& x) const {
    const double kinetic = 2.0 / 3 * x[2] * x[2] + x[3] * x[3] / 6 + std::cos(x[0] - x[1]) / 2 * x[2] * x[3];
    return m * l * l * kinetic - m * g * l * (1.5 * std::cos(x[0]) + 0.5 * std::cos(x[1]));
  }

  /// State at time t after `start`. Steps are at most 20 ms, so that the error is of the size of rounding errors.
  [[nodiscard]] State at(double t, const State& start) const {
    return integrate([this](const State& x) { return rate(x); }, start, t, static_cast<int>(std::ceil(t / 0.02)));
  }
};

}  // namespace gaitlab::oracle
