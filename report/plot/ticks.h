// Tick marks of an axis, linear, logarithmic or words: their places and texts.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace gaitlab::report {

/// Range of the data; values that are not finite do not count.
struct Bounds {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
  void add(double value);
  void add(std::span<const double> values);
  [[nodiscard]] bool empty() const { return lo > hi; }
  /// From 0 at the lower end to 1; 0.5 for a single value.
  [[nodiscard]] double share(double value) const { return hi > lo ? (value - lo) / (hi - lo) : 0.5; }
};

struct Tick {
  double at = 0;
  std::string text;  ///< numbers with a real minus sign
};

/// An axis from `lo` to `hi` with its marks: in the unit of the values; on a logarithmic axis all places are logarithms to base
/// 10, on an axis of words their indices.
struct Ticks {
  double lo = 0, hi = 1;
  std::vector<Tick> marks = {};
  double step = 0;  ///< distance of the marks on a linear axis; otherwise 0
};

/// About `count` ticks for [lo, hi], which is extended to whole steps (and if it is empty).
Ticks ticks_around(double lo, double hi, int count);
/// The same for bounds; without data, from 0 to 1.
Ticks ticks_around(const Bounds& bounds, int count);

/// About `count` ticks within [lo, hi], which is unchanged.
Ticks ticks_within(double lo, double hi, int count);

/// About `count` ticks within the bounds, which are widened by a share of them; a single value is in the middle. `log`: of
/// logarithms to base 10, with ticks at 1, 2, 5, 10 ..., over many decades at 1, 10 ... or fewer
Ticks ticks_over(const Bounds& bounds, bool log, int count, double wider = 0);

/// A tick at every nth word; `beyond`: from the outermost words to the ends of the axis.
Ticks word_ticks(std::span<const std::string> words, double beyond = 0.5, std::size_t every = 1);
/// The same from top to bottom, for an axis at a side.
Ticks row_ticks(std::span<const std::string> words, std::size_t every = 1);

/// Two axes on one plot, for the ranges [lo, hi] of a and of b: as many steps below and above zero on both, so that the zeros
/// and all grid lines meet; among several divisions the one that wastes least paper. If a does not come near zero, or the
/// ranges would fill less than a third of the paper on average (one curve above zero, the other below), the axes have separate
/// ticks.
struct TwinTicks {
  Ticks a, b;
};
TwinTicks twin_ticks(double a_lo, double a_hi, double b_lo, double b_hi);

/// The smallest 1, 2 or 5 times a power of ten not below `least` (> 0).
double nice_step(double least);

/// 10^exponent.
double power_of_ten(double exponent);
double log10_of(double value);

/// A number for readers: with a real minus sign.
std::string with_minus(std::string text);

}  // namespace gaitlab::report
