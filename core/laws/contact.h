// Penalty contact law: a value and pure functions with their slopes, for one lane (double) or many.
#pragma once
#include <cstddef>

#include "core/math/functions.h"
#include "core/math/lanes.h"
#include "core/plugin/fields.h"

namespace gaitlab {

/// Fn = Kn p^k + Cd p^d p' >= 0;  Ft = -f Fn v/v_lim for |v| <= v_lim, else -f Fn v/|v|.  (eq. 12; docs/equations.md, 6)
/// p: penetration, m, > 0 in contact; p' = -vn; v: tangential velocity, m/s. Forces in N. T: double or lanes.
template <class T>
struct BasicPenaltyContact {
  T kn = 1e4, k = 1.0, cd = 1e5, d = 1.0, v_lim = 0.01;

  struct Normal {
    T fn;                ///< normal force, N, >= 0
    T normal_slope;      ///< -d(fn)/d(vn) >= 0, N s/m; 0 if fn is cut off at 0
    T stiffness;         ///< d(fn)/d(p) of the spring alone, Kn k p^(k-1) >= 0, N/m
    math::Mask<T> acts;  ///< true if fn > 0
  };
  struct Force : Normal {
    T friction_slope;       ///< gt in: tangential force = -gt v, N s/m
    math::Mask<T> sliding;  ///< true if |v| > v_lim; the slope of the friction is then gt across the slip and 0 along it
  };

  /// Normal force. `vn` is the separating velocity (> 0 if the element leaves the ground).
  [[nodiscard]] Normal normal(const T& p, const T& vn) const {
    using math::select;
    const T zero = 0.0;
    const T damper = damping(p);
    const T fn = spring(p) - damper * vn;
    const math::Mask<T> acts = math::mask_and(p > 0.0, fn > 0.0);
    return {select(acts, fn, zero), select(acts, damper, zero), select(acts, stiffness(p), zero), acts};
  }
  // Terms of the normal force: Kn p^k, N, and its slope, N/m; Cd p^d, N s/m, and its slope, N s/m^2. The terms may be NaN for p
  // <= 0 (in the air).
  [[nodiscard]] T spring(const T& p) const { return kn * power(p, k); }
  [[nodiscard]] T stiffness(const T& p) const { return kn * k * power(p, k - 1.0); }
  [[nodiscard]] T damping(const T& p) const { return cd * power(p, d); }
  [[nodiscard]] T damping_slope(const T& p) const { return cd * d * power(p, d - 1.0); }
  [[nodiscard]] math::Mask<T> slides(const Normal& n, const T& slip) const { return math::mask_and(n.acts, slip > v_lim); }
  /// Normal force and friction. `slip` is |v|, and `friction` is f of the ground.
  [[nodiscard]] Force operator()(const T& p, const T& vn, const T& slip, const T& friction) const {
    using math::select;
    const Normal n = normal(p, vn);
    const math::Mask<T> sliding = slides(n, slip);
    return {n, select(n.acts, friction * n.fn / select(sliding, slip, v_lim), T(0.0)), sliding};
  }

 private:
  static T power(const T& x, const T& e) {
    using math::select;
    const auto none = e == T(0.0);
    const auto easy = math::mask_or(none, e == T(1.0));
    const T simple = select(none, T(1.0), x);
    return math::all_lanes(easy) ? simple : select(easy, simple, math::pow(x, e));
  }
};

using PenaltyContact = BasicPenaltyContact<double>;

}  // namespace gaitlab
