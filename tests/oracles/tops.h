// Analytical motion of two tops: the asymmetric top without torque, and the symmetric heavy top.
#pragma once
#include <array>
#include <cmath>
#include <stdexcept>

#include "tests/oracles/elliptic.h"

namespace gaitlab::oracle {

/// Asymmetric top without torque, by Euler's equations in body axes (Landau and Lifshitz, Mechanics, section 37). The principal
/// moments are I1 < I2 < I3. At t = 0, w2 = 0 and w1, w3 > 0. The top spins mainly about axis 3: L^2 > 2 E I2.
class FreeTop {
 public:
  using Vector = std::array<double, 3>;

  FreeTop(const Vector& moments, double w1, double w3) : i_(moments), start_{w1, 0, w3} {
    const auto& [a, b, c] = i_;
    const double twice_energy = a * w1 * w1 + c * w3 * w3;
    const double square = a * a * w1 * w1 + c * c * w3 * w3;
    if (!(a < b && b < c && w1 > 0 && w3 > 0 && square > twice_energy * b)) throw std::invalid_argument("FreeTop");
    w2_ = std::sqrt((twice_energy * c - square) / (b * (c - b)));
    rate_ = std::sqrt((c - b) * (square - twice_energy * a) / (a * b * c));
    k_ = std::sqrt((b - a) * (twice_energy * c - square) / ((c - b) * (square - twice_energy * a)));
  }

  /// Angular velocity at time t in body axes, rad/s.
  [[nodiscard]] Vector operator()(double t) const {
    const Jacobi j = jacobi(rate_ * t, k_);
    return {start_[0] * j.cn, w2_ * j.sn, start_[2] * j.dn};
  }

  [[nodiscard]] Vector acceleration(const Vector& w) const {
    return {(i_[1] - i_[2]) / i_[0] * w[1] * w[2], (i_[2] - i_[0]) / i_[1] * w[2] * w[0],
            (i_[0] - i_[1]) / i_[2] * w[0] * w[1]};
  }

 private:
  Vector i_, start_;
  double w2_ = 0, rate_ = 0, k_ = 0;
};

/// Symmetric top with one fixed point (Goldstein, Classical Mechanics, 5.7). C is the moment of inertia about the axis of the
/// top, A that about a perpendicular axis through the fixed point. The weight mg acts at distance l from the fixed point, and
/// theta is the angle from the upward vertical.
struct HeavyTop {
  double A = 0, C = 0, mgl = 0;

  /// Spin (component of the angular velocity along the axis) for steady precession at rate W and inclination theta, rad/s.
  [[nodiscard]] double spin_for(double W, double theta) const { return (A * W * W * std::cos(theta) + mgl) / (C * W); }

  /// Largest inclination during the nutation after a release at inclination theta with spin w3 and the axis at rest, rad.
  [[nodiscard]] double turns_back(double theta, double w3) const {
    const double p = C * C * w3 * w3 / (4 * A * mgl);
    return std::acos(p - std::sqrt(p * p - 2 * p * std::cos(theta) + 1));
  }

  /// Angular acceleration theta'' at inclination theta with precession rate W and spin w3, rad/s^2.
  [[nodiscard]] double lean(double theta, double W, double w3) const {
    return std::sin(theta) * (W * W * std::cos(theta) - C / A * w3 * W + mgl / A);
  }
};

}  // namespace gaitlab::oracle
