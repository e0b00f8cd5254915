#include "report/plot/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/functions.h"

namespace gaitlab::report {

namespace {

constexpr double kSlack = 1e-9;  // share of a step; a tick that rounding moved out of the range is kept
// Share of a step; a peak may exceed the axis by this instead of extending the axis by a whole step.
constexpr double kTouch = 0.01;
constexpr double kRoom = 0.03;  // share of an axis, added at each end for a curve that touches it
constexpr double kAnyWaste = 1e300;
constexpr double kMostWaste = 9;  // largest (axis length / range), multiplied over both axes
constexpr double kHuge = 1e300;

// Extends a range that is empty or not finite.
void widen(double& lo, double& hi) {
  if (!std::isfinite(lo) || !std::isfinite(hi) || lo > hi) {
    lo = -1;
    hi = 1;
  }
  lo = std::clamp(lo, -kHuge, kHuge);  // the difference of two doubles may overflow
  hi = std::clamp(hi, -kHuge, kHuge);
  const double size = std::max(std::abs(lo), std::abs(hi));
  if (hi - lo > 1e-9 * size && hi - lo > 1e-12) return;
  const double pad = std::max(0.1 * size, 0.01);
  lo -= pad;
  hi += pad;
}

/// Text with as many decimals as the step has, or with an exponent (1e+06) for very large and very small numbers.
std::string tick_text(double value, double step) {
  if (step >= 1e6 || step < 1e-6 || std::abs(value) >= 1e7) return with_minus(fmt::format("{:.4g}", value));
  int decimals = 0;
  double scaled = step;
  while (scaled < 1 - kSlack) {
    scaled *= 10;
    ++decimals;
  }
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos && text.front() == '-';
  return zero ? text.substr(1) : with_minus(text);
}

/// Axis [lo, hi] with ticks at the multiples of a step.
Ticks linear(double lo, double hi, double step) {
  Ticks ticks{lo, hi, {}, step};
  const double first = std::ceil(lo / step - kSlack);
  const auto count = static_cast<int>(std::floor(hi / step + kSlack) - first) + 1;
  for (int k = 0; k < count; ++k) ticks.marks.push_back({(first + k) * step, tick_text((first + k) * step, step)});
  return ticks;
}

std::string short_number(double at, bool log) { return with_minus(fmt::format("{:.6g}", log ? power_of_ten(at) : at)); }

/// Ticks within [lo, hi], which are logarithms to base 10.
std::vector<Tick> log_marks(double lo, double hi, int count) {
  constexpr double kManyDecades = 3;
  const bool many = hi - lo >= kManyDecades;
  const int every = many ? static_cast<int>(std::ceil((hi - lo) / count)) : 1;
  std::vector<Tick> marks;
  for (int decade = static_cast<int>(std::floor(lo)); decade <= hi; ++decade) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double at = log10_of(digit) + decade;
      const bool within = at >= lo - kSlack && at <= hi + kSlack;
      if (within && decade % every == 0 && (digit < 2 || !many)) marks.push_back({at, short_number(at, true)});
    }
  }
  constexpr std::size_t kFew = 3;
  if (many || marks.size() >= kFew) return marks;
  // If the range is below a factor of 10, ticks may be round numbers as on a linear axis.
  marks = ticks_within(power_of_ten(lo), power_of_ten(hi), count).marks;
  for (Tick& mark : marks) mark.at = log10_of(mark.at);
  return marks;
}

}  // namespace

void Bounds::add(double value) {
  if (!std::isfinite(value)) return;
  lo = std::min(lo, value);
  hi = std::max(hi, value);
}

void Bounds::add(std::span<const double> values) {
  for (const double value : values) add(value);
}

double nice_step(double least) {
  double power = 1;
  while (power > least) power /= 10;
  while (power * 10 <= least) power *= 10;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1 - kSlack)) return factor * power;
  }
  return 10 * power;
}

double power_of_ten(double exponent) { return math::exp(exponent * math::log(10)); }

double log10_of(double value) { return math::log(value) / math::log(10); }

std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  return text;
}

Ticks ticks_around(double lo, double hi, int count) {
  widen(lo, hi);
  const double step = nice_step((hi - lo) / count * (1 - kTouch));
  return linear(std::floor(lo / step + kTouch) * step, std::ceil(hi / step - kTouch) * step, step);
}

Ticks ticks_around(const Bounds& bounds, int count) {
  return bounds.empty() ? ticks_around(0, 1, count) : ticks_around(bounds.lo, bounds.hi, count);
}

Ticks ticks_within(double lo, double hi, int count) {
  widen(lo, hi);
  return linear(lo, hi, nice_step((hi - lo) / count));
}

Ticks ticks_over(const Bounds& bounds, bool log, int count, double wider) {
  if (bounds.empty()) return {};
  const double wide = bounds.hi - bounds.lo;
  if (!(wide > 0)) return {bounds.lo - 0.5, bounds.lo + 0.5, {{bounds.lo, short_number(bounds.lo, log)}}};
  const double lo = bounds.lo - wider * wide;
  const double hi = bounds.hi + wider * wide;
  return log ? Ticks{lo, hi, log_marks(lo, hi, count)} : ticks_within(lo, hi, count);
}

Ticks word_ticks(std::span<const std::string> words, double beyond, std::size_t every) {
  Ticks ticks{-beyond, static_cast<double>(words.size()) - 1 + beyond, {}};
  for (std::size_t k = 0; k < words.size(); k += every) ticks.marks.push_back({static_cast<double>(k), words[k]});
  return ticks;
}

Ticks row_ticks(std::span<const std::string> words, std::size_t every) {
  Ticks ticks = word_ticks(words, 0.5, every);
  std::swap(ticks.lo, ticks.hi);
  return ticks;
}

TwinTicks twin_ticks(double a_lo, double a_hi, double b_lo, double b_hi) {
  widen(a_lo, a_hi);
  widen(b_lo, b_hi);
  const TwinTicks separate{ticks_around(a_lo, a_hi, 6), ticks_around(b_lo, b_hi, 6)};
  TwinTicks best;
  double least_waste = kAnyWaste;
  for (const int count : {6, 4, 5, 8, 10}) {
    const Ticks a = ticks_around(a_lo, a_hi, count);
    if (a.lo > 0.5 * a.step || a.hi < -0.5 * a.step) continue;
    for (int more = 0; more < 3; ++more) {
      const double below = std::round(-a.lo / a.step) + (a_lo < 0 || b_lo < 0 ? more : 0);
      const double above = std::round(a.hi / a.step) + (a_hi > 0 || b_hi > 0 ? more : 0);
      if (below + above > 10 || below + above < 3 || (b_lo < 0 && below < 1) || (b_hi > 0 && above < 1)) continue;
      const double steps = below + above;
      const double least = std::max({b_lo < 0 ? -b_lo / below : 0, b_hi > 0 ? b_hi / above : 0, 1e-12});
      const double step = nice_step(least * (1 - kTouch / steps));
      const double waste = steps * a.step / (a_hi - a_lo) * steps * step / (b_hi - b_lo);
      if (waste >= least_waste * (1 - kSlack)) continue;
      least_waste = waste;
      best = {linear(-below * a.step, above * a.step, a.step), linear(-below * step, above * step, step)};
    }
  }
  return least_waste > kMostWaste ? separate : best;
}

void make_room(TwinTicks& ticks, const Bounds& a, const Bounds& b) {
  const auto touches = [](const Ticks& axis, const Bounds& values) {
    const double near = 0.5 * kRoom * (axis.hi - axis.lo);
    return !values.empty() && (values.lo < axis.lo + near || values.hi > axis.hi - near);
  };
  if (!touches(ticks.a, a) && !touches(ticks.b, b)) return;
  for (Ticks* axis : {&ticks.a, &ticks.b}) {
    const double room = kRoom * (axis->hi - axis->lo);
    axis->lo -= room;
    axis->hi += room;
  }
}

}  // namespace gaitlab::report
