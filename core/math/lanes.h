// What code that is written once, for a double and for a vector of doubles (a lane per rollout), asks of its scalar: choice by
// mask where a double would branch. A lane type brings its own overloads.
#pragma once
#include <cmath>
#include <span>

namespace gaitlab::math {

/// What comparing two scalars gives: bool, or a bool per lane.
template <class T>
using Mask = decltype(T{} < T{});

inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
/// yes and not already
inline bool fresh(bool yes, bool already) { return yes && !already; }
/// Whether work may be skipped: it is masked off in every lane.
inline bool any(bool mask) { return mask; }
inline double sqrt(double x) { return std::sqrt(x); }  // exact to rounding everywhere, unlike its kin (core/math/functions.h)
/// As plain numbers, entry * lanes + lane.
inline std::span<double> numbers(std::span<double> x) { return x; }

}  // namespace gaitlab::math
