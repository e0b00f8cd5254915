// The penalty contact law: a value and pure functions with their slopes, for one lane (double) or many.
#pragma once
#include <cstddef>

#include "core/math/functions.h"
#include "core/plugin/fields.h"

namespace gaitlab {

/// Fn = Kn p^k + Cd p^d p' >= 0;  Ft = -f Fn v/v_lim for |v| <= v_lim, else -f Fn v/|v|.  (eq. 12; docs/equations.md, 6)
/// p: penetration, m, > 0 in contact; p' = -vn; v: tangential velocity, m/s. Forces in N.
struct PenaltyContact {
  double kn = 1e4, k = 1, cd = 1e5, d = 1, v_lim = 0.01;

  struct Force {
    double fn = 0;              ///< normal force, N, >= 0
    double normal_slope = 0;    ///< -d(fn)/d(vn) >= 0, N s/m; 0 where fn is cut off at 0
    double stiffness = 0;       ///< d(fn)/d(p), N/m
    double friction_slope = 0;  ///< gt: tangential force = -gt v, N s/m
    bool sliding = false;       ///< |v| > v_lim: the slope of the friction is gt across the slip and 0 along it
  };

  /// vn: separating velocity (> 0 leaves the ground); slip: |v|; friction: f of the ground.
  [[nodiscard]] Force operator()(double p, double vn, double slip, double friction) const {
    Force force;
    if (!(p > 0)) return force;
    const double damping = cd * power(p, d);
    force.fn = kn * power(p, k) - damping * vn;
    if (!(force.fn > 0)) {
      force.fn = 0;
      return force;
    }
    force.normal_slope = damping;
    force.stiffness = kn * k * power(p, k - 1) - cd * d * power(p, d - 1) * vn;
    force.sliding = slip > v_lim;
    force.friction_slope = friction * force.fn / (force.sliding ? slip : v_lim);
    return force;
  }

 private:
  static double power(double x, double e) { return e == 1 ? x : e == 0 ? 1 : math::pow(x, e); }
};

}  // namespace gaitlab
