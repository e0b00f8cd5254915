// Line search along the step of Newton's method, for a scalar type T (double or lanes).
#pragma once
#include "core/math/lanes.h"

namespace gaitlab::articulated {

/// Share of a way, in the lanes `which`, up to which a strictly convex function falls. It is 1 if the function falls up to the
/// end. Otherwise it is the share at which the slope of the function is 0, to 1 % of the slope at the start of the way (regula
/// falsi, every third time a bisection). `climb` returns the slope at a share. Does not allocate.
template <class T, class Climb>
T falling_share(const math::Mask<T>& which, const Climb& climb) {
  using math::select;
  const T zero = 0.0, one = 1.0;
  T hi = one, f_hi = climb(one);
  auto open = math::mask_and(which, f_hi > zero);
  if (!math::any_lane(open)) return one;
  const T start = climb(zero);
  open = math::mask_and(open, start < zero);
  T lo = zero, f_lo = start, result = one;
  for (int i = 0; i < 40 && math::any_lane(open); ++i) {
    const T a = i % 3 == 2 ? 0.5 * (lo + hi) : lo + (hi - lo) * f_lo / select(open, f_lo - f_hi, one);
    const T f = climb(a);
    result = select(open, a, result);
    open = math::mask_and(open, math::abs(f) > -0.01 * start);
    const auto below = f < zero;
    lo = select(below, a, lo);
    f_lo = select(below, f, f_lo);
    hi = select(below, hi, a);
    f_hi = select(below, f_hi, f);
  }
  return result;
}

}  // namespace gaitlab::articulated
