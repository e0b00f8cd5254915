// Analytical motion of a block on n contact elements with equal loads, under the contact law of eq. 12: the normal force is
// Fn = Kn p^k + Cd p^d p', and the friction f Fn is regularised below the speed v_lim.
#pragma once
#include <cmath>

namespace gaitlab::oracle {

/// Block that slides with an initial speed v0 > v_lim. The normal force is constant; on level ground it is m g.
struct SlidingBlock {
  double f = 0, g = 0, v_lim = 0;

  /// Stopping distance on level ground. It is the sum of (v0^2 - v_lim^2) / (2 f g) at full friction, and of v_lim^2 / (f g)
  /// below v_lim, where v' = -f g v / v_lim.
  [[nodiscard]] double stops_after(double v0) const { return (v0 * v0 + v_lim * v_lim) / (2 * f * g); }

  [[nodiscard]] double speed(double v0, double t) const {
    const double full = (v0 - v_lim) / (f * g);
    return t <= full ? v0 - f * g * t : v_lim * std::exp(-(t - full) * f * g / v_lim);
  }

  /// Steady speed on a slope of angle a < atan(f), at which the friction f Fn v / v_lim balances the weight along the slope.
  [[nodiscard]] double creeps(double a) const { return v_lim * std::tan(a) / f; }
};

/// Depth at which n elements with k = 1 carry the weight.
inline double standing_sink(double m, double g, double n, double kn) { return m * g / (n * kn); }

/// Vertical oscillation about the depth standing_sink with k = 1, d = 0 and uninterrupted contact: m z'' = -n Kn z - n Cd z'.
struct StandingBlock {
  double m = 0, n = 0, kn = 0, cd = 0;

  [[nodiscard]] double decay() const { return n * cd / (2 * m); }
  [[nodiscard]] double frequency() const { return std::sqrt(n * kn / m - decay() * decay()); }
  /// Height above the depth of rest at time t after a release from height z0 at rest.
  [[nodiscard]] double height(double z0, double t) const {
    const double w = frequency();
    return z0 * std::exp(-decay() * t) * (std::cos(w * t) + decay() / w * std::sin(w * t));
  }
};

/// Speed after a bounce with k = d = 1 and without weight, by bisection. With a = Cd / Kn, integration of
/// m v dv = -n Kn p (1 + a v) dp from p = 0 back to p = 0 gives a (v_in + v_out) = ln((1 + a v_in) / (1 - a v_out)).
inline double bounces_with(double v_in, double kn, double cd) {
  const double a = cd / kn;
  const auto left_over = [&](double v) { return a * (v_in + v) - std::log((1 + a * v_in) / (1 - a * v)); };
  double low = 0;  // left_over(0) is positive
  double high = std::fmin(v_in, (1 - 1e-15) / a);
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (left_over(middle) > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace gaitlab::oracle
