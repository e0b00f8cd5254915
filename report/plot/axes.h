// Axes: steps of 1, 2 or 5, their labels, and the way from a value to the paper.
#pragma once
#include <string>
#include <vector>

#include "report/plot/canvas.h"

namespace gaitlab::report {

// What all figures share.
inline constexpr double kWidth = 1000;      ///< px, of the sheet
inline constexpr double kTitleHeight = 44;  ///< px
inline constexpr Style kGridLine{.stroke = colour::kPale};
inline constexpr Style kAxisLine{.stroke = colour::kInk, .width = 1.2};

/// The smallest 1, 2 or 5 times a power of ten not below `least` (> 0).
double nice_step(double least);

/// A range from one tick to another.
struct Ticks {
  double lo = 0, hi = 1, step = 1;
  /// The multiples of step within [lo, hi].
  [[nodiscard]] std::vector<double> values() const;
  /// As many decimals as the step has; 1e+06 and the like for very large or small ones.
  [[nodiscard]] std::string label(double value) const;
};

/// About `count` ticks around [lo, hi], which is widened to whole steps (and if it is empty).
Ticks ticks_around(double lo, double hi, int count);

/// [lo, hi] as it is, with about `count` ticks in it.
Ticks ticks_within(double lo, double hi, int count);

/// Two axes on one panel, for the ranges [lo, hi] of a and of b: as many steps below and above zero on both, so that the zeros
/// and all grid lines meet; of several divisions the one that wastes least paper. If a does not come near zero, or the ranges
/// would fill less than a third of the paper on average (one curve above zero, the other below), each axis has its own ticks.
struct TwinTicks {
  Ticks a, b;
};
TwinTicks twin_ticks(double a_lo, double a_hi, double b_lo, double b_hi);

/// Maps [lo, hi] to [from, to], px.
struct Scale {
  double lo = 0, hi = 1, from = 0, to = 1;
  [[nodiscard]] double operator()(double value) const { return from + (value - lo) / (hi - lo) * (to - from); }
};

/// At most two points per `cell` of width (px): the lowest and highest of each, in their order, so that peaks survive. `points`
/// in px, by rising x.
std::vector<Point> thinned(const std::vector<Point>& points, double cell = 1);

}  // namespace gaitlab::report
