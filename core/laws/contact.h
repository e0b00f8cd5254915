// The penalty contact law: a value and pure functions with their slopes, for one lane (double) or many.
#pragma once
#include <cstddef>

#include "core/math/functions.h"
#include "core/math/lanes.h"
#include "core/plugin/fields.h"

namespace gaitlab {

/// Fn = Kn p^k + Cd p^d p' >= 0;  Ft = -f Fn v/v_lim for |v| <= v_lim, else -f Fn v/|v|.  (eq. 12; docs/equations.md, 6)
/// p: penetration, m, > 0 in contact; p' = -vn; v: tangential velocity, m/s. Forces in N.
struct PenaltyContact {
  double kn = 1e4, k = 1, cd = 1e5, d = 1, v_lim = 0.01;

  template <class T>
  struct Force {
    T fn;                         ///< normal force, N, >= 0
    T normal_slope;               ///< -d(fn)/d(vn) >= 0, N s/m; 0 where fn is cut off at 0
    T stiffness;                  ///< d(fn)/d(p) of the spring, Kn k p^(k-1) >= 0, N/m
    T friction_slope;             ///< gt: tangential force = -gt v, N s/m
    math::Mask<T> acts, sliding;  ///< fn > 0; |v| > v_lim: the slope of the friction is gt across the slip and 0 along it
  };

  /// vn: separating velocity (> 0 leaves the ground); slip: |v|; friction: f of the ground. T: double or lanes.
  template <class T>
  [[nodiscard]] Force<T> operator()(T p, T vn, T slip, double friction) const {
    using math::select;
    const T zero = 0.0;
    const T damping = cd * power(p, d);  // no number in the air, perhaps: not taken there
    const T fn = kn * power(p, k) - damping * vn;
    const math::Mask<T> acts = math::both(p > 0.0, fn > 0.0);
    const math::Mask<T> sliding = math::both(acts, slip > v_lim);
    return {select(acts, fn, zero),
            select(acts, damping, zero),
            select(acts, kn * k * power(p, k - 1), zero),
            select(acts, friction * fn / select(sliding, slip, T(v_lim)), zero),
            acts,
            sliding};
  }

 private:
  template <class T>
  static T power(T x, double e) {
    return e == 1 ? x : e == 0 ? T(1.0) : math::pow(x, e);
  }
};

}  // namespace gaitlab
