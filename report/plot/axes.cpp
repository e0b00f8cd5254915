#include "report/plot/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gaitlab::report {

namespace {

constexpr double kSlack = 1e-9;  // of a step: a tick that rounding moved out of the range still counts
constexpr double kTouch = 0.01;  // of a step: a peak may stick out so little rather than cost a whole step of paper
constexpr double kAnyWaste = 1e300;
constexpr double kMostWaste = 9;  // product of height over range of both axes
constexpr double kHuge = 1e300;

// A range that is empty or not finite, made drawable.
void widen(double& lo, double& hi) {
  if (!std::isfinite(lo) || !std::isfinite(hi) || lo > hi) {
    lo = -1;
    hi = 1;
  }
  lo = std::clamp(lo, -kHuge, kHuge);  // the difference of two doubles may be none
  hi = std::clamp(hi, -kHuge, kHuge);
  const double size = std::max(std::abs(lo), std::abs(hi));
  if (hi - lo > 1e-9 * size && hi - lo > 1e-12) return;
  const double pad = std::max(0.1 * size, 0.01);
  lo -= pad;
  hi += pad;
}

}  // namespace

double nice_step(double least) {
  double power = 1;
  while (power > least) power /= 10;
  while (power * 10 <= least) power *= 10;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1 - kSlack)) return factor * power;
  }
  return 10 * power;
}

std::vector<double> Ticks::values() const {
  std::vector<double> values;
  const double first = std::ceil(lo / step - kSlack);
  const auto count = static_cast<int>(std::floor(hi / step + kSlack) - first) + 1;
  values.reserve(static_cast<std::size_t>(std::max(0, count)));
  for (int k = 0; k < count; ++k) values.push_back((first + k) * step);
  return values;
}

std::string Ticks::label(double value) const {
  if (step >= 1e6 || step < 1e-6 || std::abs(value) >= 1e7) return fmt::format("{:.4g}", value);
  int decimals = 0;
  double scaled = step;
  while (scaled < 1 - kSlack) {
    scaled *= 10;
    ++decimals;
  }
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
}

Ticks ticks_around(double lo, double hi, int count) {
  widen(lo, hi);
  const double step = nice_step((hi - lo) / count * (1 - kTouch));
  return {std::floor(lo / step + kTouch) * step, std::ceil(hi / step - kTouch) * step, step};
}

Ticks ticks_within(double lo, double hi, int count) {
  widen(lo, hi);
  return {lo, hi, nice_step((hi - lo) / count)};
}

TwinTicks twin_ticks(double a_lo, double a_hi, double b_lo, double b_hi) {
  widen(a_lo, a_hi);
  widen(b_lo, b_hi);
  TwinTicks best{ticks_around(a_lo, a_hi, 6), ticks_around(b_lo, b_hi, 6)};
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
      best = {{-below * a.step, above * a.step, a.step}, {-below * step, above * step, step}};
    }
  }
  const TwinTicks own{ticks_around(a_lo, a_hi, 6), ticks_around(b_lo, b_hi, 6)};
  return least_waste > kMostWaste ? own : best;
}

std::vector<Point> thinned(const std::vector<Point>& points, double cell) {
  if (points.size() < 4) return points;
  if (static_cast<double>(points.size()) <= 2 * (points.back().x - points.front().x) / cell) return points;
  std::vector<Point> kept;
  for (std::size_t first = 0; first < points.size();) {
    const double pixel = std::floor(points[first].x / cell);
    std::size_t low = first;
    std::size_t high = first;
    std::size_t next = first;
    // A point that is not finite ends its pixel and is kept: the line is broken there.
    for (; next < points.size() && std::floor(points[next].x / cell) == pixel && std::isfinite(points[next].y); ++next) {
      if (points[next].y < points[low].y) low = next;
      if (points[next].y > points[high].y) high = next;
    }
    kept.push_back(points[std::min(low, high)]);
    if (low != high) kept.push_back(points[std::max(low, high)]);
    first = std::max(next, first + 1);
  }
  return kept;
}

}  // namespace gaitlab::report
