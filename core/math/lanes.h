// Scalar operations for code that is written once for a double and for a vector of doubles (a lane per rollout), with masks
// instead of branches. Vector types define overloads of these functions (core/math/doubles.h).
#pragma once
#include <cmath>
#include <cstddef>
#include <span>

namespace gaitlab::math {

/// Result of comparing two scalars: bool, or a bool per lane.
template <class T>
using Mask = decltype(T{} < T{});
/// Number of lanes of a scalar.
template <class T>
inline constexpr std::size_t kLanes = sizeof(T) / sizeof(double);

inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
inline bool mask_and(bool a, bool b) { return a && b; }
inline bool mask_or(bool a, bool b) { return a || b; }
/// Returns `yes` and not `already`.
inline bool fresh(bool yes, bool already) { return yes && !already; }
/// True if the mask is set in any lane, or in all lanes.
inline bool any_lane(bool mask) { return mask; }
inline bool all_lanes(bool mask) { return mask; }
inline double sqrt(double x) {
  return std::sqrt(x);
}  // exactly rounded everywhere, unlike other functions (core/math/functions.h)
inline double abs(double x) { return std::abs(x); }
template <class T>
T clamp(const T& x, const T& lo, const T& hi) {
  return select(x < lo, lo, select(hi < x, hi, x));
}

/// View of the values of all lanes as plain numbers, with index entry * lanes + lane.
template <class T>
std::span<double> numbers(std::span<T> x) {
  return {reinterpret_cast<double*>(x.data()), x.size() * kLanes<T>};
}
template <class T>
std::span<const double> numbers(std::span<const T> x) {
  return {reinterpret_cast<const double*>(x.data()), x.size() * kLanes<T>};
}
template <class T>
double& lane(T& x, std::size_t l) {
  return reinterpret_cast<double*>(&x)[l];
}
template <class T>
double lane(const T& x, std::size_t l) {
  return reinterpret_cast<const double*>(&x)[l];
}

}  // namespace gaitlab::math
