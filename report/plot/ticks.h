// Tick marks of a linear or logarithmic axis or of an axis of words: positions and texts.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace gaitlab::report {

/// Range of the data. Values that are not finite are ignored.
struct Bounds {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
  void add(double value);
  void add(std::span<const double> values);
  [[nodiscard]] bool empty() const { return lo > hi; }
  /// True for a number outside the range. False if the range is empty, or for a value that is not finite.
  [[nodiscard]] bool beyond(double value) const { return !empty() && (value < lo || value > hi); }
  /// Position of a value in the range, from 0 at the lower end to 1 at the upper end; 0.5 if the range is a single value.
  [[nodiscard]] double share(double value) const { return hi > lo ? (value - lo) / (hi - lo) : 0.5; }
};

struct Tick {
  double at = 0;
  std::string text;  ///< number with a typographic minus sign, or word
};

/// An axis from `lo` to `hi` with its marks. Positions are in the unit of the values, logarithms to base 10 on a logarithmic
/// axis, and indices on an axis of words.
struct Ticks {
  double lo = 0, hi = 1;
  std::vector<Tick> marks = {};
  double step = 0;  ///< distance of the marks on a linear axis; 0 on other axes
};

/// About `count` ticks for [lo, hi]. The axis is extended to whole steps, and also if the range is empty.
Ticks ticks_around(double lo, double hi, int count);
/// About `count` ticks for bounds; for empty bounds the axis is from 0 to 1.
Ticks ticks_around(const Bounds& bounds, int count);

/// About `count` ticks within [lo, hi]. The ends of the axis are not changed.
Ticks ticks_within(double lo, double hi, int count);

/// About `count` ticks within bounds that are widened by the share `wider`. A single value is in the middle of the axis. With
/// `log` the bounds are logarithms to base 10, and ticks are at 1, 2, 5, 10, ...; over many decades at 1, 10, ... or fewer.
Ticks ticks_over(const Bounds& bounds, bool log, int count, double wider = 0);

/// A tick at every nth word (`every`). `beyond` is the distance from the outermost words to the ends of the axis.
Ticks word_ticks(std::span<const std::string> words, double beyond = 0.5, std::size_t every = 1);
/// As word_ticks, but from top to bottom, for an axis at a side.
Ticks row_ticks(std::span<const std::string> words, std::size_t every = 1);

/// Two axes of one plot, for the ranges [lo, hi] of a and of b. Both axes have equally many steps below and above zero, so that
/// their zeros and grid lines coincide. Among several divisions, the one that wastes the least area is chosen. The axes have
/// separate ticks if the range of a is far from zero, or if the ranges would use less than a third of the height on average, as
/// with one curve above zero and the other below.
struct TwinTicks {
  Ticks a, b;
};
TwinTicks twin_ticks(double a_lo, double a_hi, double b_lo, double b_hi);

/// Extends both axes by the same share at both ends if a value touches an end of its axis, so that its curve is not on the
/// frame. The zeros still coincide.
void make_room(TwinTicks& ticks, const Bounds& a, const Bounds& b);

/// Smallest number of the form 1, 2 or 5 times a power of ten that is not below `least` (> 0).
double nice_step(double least);

/// 10^exponent, and the logarithm to base 10.
double power_of_ten(double exponent);
double log10_of(double value);

/// Text of a number in which a hyphen as sign is replaced by a typographic minus sign.
std::string with_minus(std::string text);

}  // namespace gaitlab::report
