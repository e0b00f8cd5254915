// Number of steps in a period.
#pragma once
#include <cmath>
#include <cstdint>

namespace gaitlab::math {

/// Number of steps in a period, rounded to the nearest whole number.
inline std::int64_t steps_in(double period, double step) { return std::llround(period / step); }

/// Number of steps in a period if it is whole within 1e-9 relative, else 0.
inline double whole_steps(double period, double step) {
  constexpr double kTolerance = 1e-9;
  const double ratio = period / step;
  const double whole = std::round(ratio);
  return whole >= 1 && std::isfinite(ratio) && std::abs(ratio - whole) <= kTolerance * ratio ? whole : 0;
}

}  // namespace gaitlab::math
