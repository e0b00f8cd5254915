#include "core/recording/time_shift.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gaitlab {

namespace {

using Index = std::ptrdiff_t;

constexpr double kShare = 0.05;      // largest shift as a share of the duration
constexpr double kReach = 0.5;       // s
constexpr double kWorthwhile = 0.5;  // largest remaining share of the RMS; with a larger share, the signals differ in shape
constexpr double kAsGood = 0.01;     // share of the mean square; shifts that differ by less are equally good
constexpr std::size_t kProducts = 1000000;
constexpr Index kMargin = 2;  // samples that the cubic needs in addition to the whole shift

class ShiftSearch {
 public:
  ShiftSearch(std::span<const double> first, std::span<const double> second, Index reach)
      : a_(first), b_(second), reach_(reach), begin_(reach + kMargin), end_(static_cast<Index>(first.size()) - begin_) {}

  // Best shift, in samples.
  TimeShift best() const {
    const double unshifted = square(0, 1);
    Index lag = refined(coarse(unshifted));
    double shift = static_cast<double>(lag);
    double remaining = square(lag, 1);
    if (std::abs(lag) < reach_) {
      const double between = shift + vertex(square(lag - 1, 1), remaining, square(lag + 1, 1));
      const double there = square_between(between);
      if (there < remaining) {
        shift = between;
        remaining = there;
      }
    }
    if (std::abs(lag) >= reach_) return {};  // minimum at the edge of the window: a trend, not a shift
    if (remaining > kWorthwhile * kWorthwhile * unshifted) return {};
    return {shift, std::sqrt(remaining)};
  }

 private:
  // Mean of (b[k + lag] - a[k])^2 over every `stride`-th sample; four independent sums for speed.
  [[nodiscard]] double square(Index lag, Index stride) const {
    double sums[4] = {};
    Index k = begin_;
    Index count = 0;
    const double* const a = a_.data();
    const double* const b = b_.data() + lag;
    for (; k + 3 * stride < end_; k += 4 * stride, count += 4) {
      for (Index i = 0; i < 4; ++i) {
        const double d = b[k + i * stride] - a[k + i * stride];
        sums[i] += d * d;
      }
    }
    for (; k < end_; k += stride, ++count) sums[0] += (b[k] - a[k]) * (b[k] - a[k]);
    return (sums[0] + sums[1] + sums[2] + sums[3]) / static_cast<double>(count);
  }

  // Mean square as in square(), for a shift between samples. The cubic passes through the four neighbours (Lagrange).
  [[nodiscard]] double square_between(double shift) const {
    const double floor = std::floor(shift);
    const auto lag = static_cast<Index>(floor);
    const double x = shift - floor;
    const double w[4] = {-x * (x - 1) * (x - 2) / 6, (x + 1) * (x - 1) * (x - 2) / 2, -(x + 1) * x * (x - 2) / 2,
                         (x + 1) * x * (x - 1) / 6};
    double sum = 0;
    for (Index k = begin_; k < end_; ++k) {
      const double* const b = b_.data() + k + lag;
      const double d = w[0] * b[-1] + w[1] * b[0] + w[2] * b[1] + w[3] * b[2] - a_[static_cast<std::size_t>(k)];
      sum += d * d;
    }
    return sum / static_cast<double>(end_ - begin_);
  }

  // Vertex of the parabola through three neighbours, relative to the middle neighbour. 0 if the parabola opens downwards.
  static double vertex(double before, double here, double after) {
    const double bend = before - 2 * here + after;
    return bend > 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
  }
  static double lowest(double before, double here, double after) {
    return std::max(0.0, here - 0.25 * (before - after) * vertex(before, here, after));
  }

  // Smallest whole shift that is as good as any other, computed from a limited number of rows.
  [[nodiscard]] Index coarse(double unshifted) const {
    const auto products = static_cast<std::size_t>(2 * reach_ + 1) * static_cast<std::size_t>(end_ - begin_);
    const auto stride = static_cast<Index>(products / kProducts + 1);
    std::vector<double> squares;
    for (Index lag = -reach_; lag <= reach_; ++lag) squares.push_back(square(lag, stride));
    const Index last = 2 * reach_;
    std::vector<double> valleys(squares.size(), INFINITY);
    for (Index i = 0; i <= last; ++i) {
      const auto at = [&](Index j) { return squares[static_cast<std::size_t>(std::clamp<Index>(j, 0, last))]; };
      if (at(i) > at(i - 1) || at(i) > at(i + 1)) continue;
      valleys[static_cast<std::size_t>(i)] = i == 0 || i == last ? at(i) : lowest(at(i - 1), at(i), at(i + 1));
    }
    const double enough = *std::min_element(valleys.begin(), valleys.end()) + kAsGood * unshifted;
    Index found = reach_;
    for (Index i = 0; i <= last; ++i) {
      const Index lag = i - reach_;
      if (valleys[static_cast<std::size_t>(i)] <= enough && (std::abs(lag) < std::abs(found))) found = lag;
    }
    return found;
  }

  // Nearest minimum of the mean square over all rows, by descent from `lag`.
  [[nodiscard]] Index refined(Index lag) const {
    for (const Index step : {-1, 1}) {
      while (std::abs(lag + step) <= reach_ && square(lag + step, 1) < square(lag, 1)) lag += step;
    }
    return lag;
  }

  std::span<const double> a_, b_;
  Index reach_, begin_, end_;
};

double plain_rms(std::span<const double> first, std::span<const double> second) {
  double sum = 0;
  for (std::size_t k = 0; k < first.size(); ++k) sum += (second[k] - first[k]) * (second[k] - first[k]);
  return first.empty() ? 0 : std::sqrt(sum / static_cast<double>(first.size()));
}

}  // namespace

TimeShift best_shift(std::span<const double> first, std::span<const double> second, double spacing) {
  const TimeShift none{0, plain_rms(first, second)};
  const double samples = std::min(kShare * static_cast<double>(first.size()), kReach / spacing);
  const auto reach = static_cast<Index>(samples);
  if (reach < 1 || !(none.rms > 0)) return none;  // the window has 0.9 n - 4 samples; not empty for n >= 20
  const TimeShift found = ShiftSearch(first, second, reach).best();
  return found.time == 0 ? none : TimeShift{found.time * spacing, found.rms};
}

}  // namespace gaitlab
