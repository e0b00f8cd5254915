// Limit of vanishing steps, extrapolated from a run with the step and a run with half of it.
#pragma once
#include <cmath>

namespace gaitlab::studies {

/// Value extrapolated to a vanishing step, for a method of this order (Richardson 1911):
///     x = x(h/2) + (x(h/2) - x(h)) / (2^order - 1)
/// It is exact if the error is proportional to h^order.
inline double step_limit(double at_step, double at_half, int order) {
  return at_half + (at_half - at_step) / (std::ldexp(1.0, order) - 1);
}

}  // namespace gaitlab::studies
