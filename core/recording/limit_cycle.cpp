#include "core/recording/limit_cycle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace gaitlab {

namespace {

constexpr double kStill = 1e-3;  // rad, half of the peak-to-peak range
constexpr double kSmall =
    0.1;  // least scale, as a share of the largest scale, so that trembling joints do not decide the result
constexpr double kPromising = 0.3;    // largest error e for a lag that is half a grid step from a period, also with harmonics
constexpr std::size_t kGrid = 256;    // lags and points per period in the search
constexpr std::size_t kFine = 4096;   // points per period when refining a lag
constexpr std::size_t kShortest = 5;  // samples in the shortest period
constexpr double kNoMatch = 1e300;    // error above every threshold
using Moved = std::vector<double>;

struct Columns : std::vector<Moved> {
  using std::vector<Moved>::vector;
  double floor = kStill;          // smallest scale of a column, rad
  mutable std::size_t pairs = 0;  // pairs of samples compared so far
};

struct Range {
  double lo = kNoMatch, hi = -kNoMatch;
  void add(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  [[nodiscard]] double half() const { return 0.5 * (hi - lo); }
};

// Replaces the steps of a column that is constant between ticks by straight lines between the changes. Only intervals up to
// twice the median are joined, so that pauses remain.
void join_steps(Moved& x) {
  std::vector<std::size_t> changes;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] != x[i - 1]) changes.push_back(i);
  }
  if (changes.size() < 3) return;
  std::vector<std::size_t> runs;
  for (std::size_t k = 1; k < changes.size(); ++k) runs.push_back(changes[k] - changes[k - 1]);
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::nth_element(runs.begin(), middle, runs.end());
  for (std::size_t k = 1; k < changes.size(); ++k) {
    const std::size_t first = changes[k - 1];
    const std::size_t length = changes[k] - first;
    if (length > 2 * *middle) continue;
    const double step = (x[changes[k]] - x[first]) / static_cast<double>(length);
    for (std::size_t i = 1; i < length; ++i) x[first + i] = x[first] + step * static_cast<double>(i);
  }
}

// One contiguous array per column. Empty if a number is not finite.
Columns columns_of(std::span<const double> values, std::size_t columns) {
  const std::size_t rows = values.size() / columns;
  Columns split(columns, Moved(rows));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < columns; ++c) {
      const double value = values[row * columns + c];
      if (!std::isfinite(value)) return {};
      split[c][row] = value;
    }
  }
  for (Moved& column : split) join_steps(column);
  // Least scale, from the last quarter of the data, because larger motions at the start must not count.
  for (const Moved& column : split) {
    Range range;
    for (std::size_t row = rows - rows / 4; row < rows; ++row) range.add(column[row]);
    split.floor = std::max(split.floor, kSmall * range.half());
  }
  return split;
}

// Rough error e in the last window, for a lag of whole samples, from every `stride`-th sample. The result is kNoMatch if the
// error exceeds kPromising or nothing moves.
class RoughError {
 public:
  explicit RoughError(const Columns& columns) : columns_(columns) {
    for (std::size_t c = 0; c < columns.size(); ++c) order_.push_back(c);
  }

  double error(std::size_t lag, std::size_t stride) {
    double worst = 0;
    bool moves = false;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const auto [one, half] = of(columns_[order_[k]], lag, stride);
      moves = moves || half > kStill;
      worst = std::max(worst, one);
      if (worst < kPromising) continue;
      // A column that does not repeat after one lag usually does not repeat after the next lag either, and is therefore tested
      // first.
      std::rotate(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(k),
                  order_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      return kNoMatch;
    }
    return moves ? worst : kNoMatch;
  }

 private:
  // Error of one column, and half of its peak-to-peak value.
  [[nodiscard]] std::pair<double, double> of(const Moved& x, std::size_t lag, std::size_t stride) const {
    const std::size_t rows = x.size();
    Range range;
    double squares = 0;
    std::size_t count = 0;
    for (std::size_t back = 0; back < lag; back += stride, ++count) {
      const double later = x[rows - 1 - back];
      const double earlier = x[rows - 1 - back - lag];
      range.add(later);
      range.add(earlier);
      squares += (later - earlier) * (later - earlier);
    }
    columns_.pairs += count;
    const double scale = std::max(range.half(), columns_.floor);
    return {std::sqrt(squares / static_cast<double>(count)) / scale, range.half()};
  }

  const Columns& columns_;
  std::vector<std::size_t> order_ = {};
};

// Misfit of a lag: sum over the columns of the mean square of (x(t) - x(t - lag)) / s_c over a fixed window at the end. Unlike
// the error of the worst column, it is smooth in the lag, and close to a parabola near its minimum.
class Misfit {
 public:
  Misfit(const Columns& columns, std::size_t window) : columns_(columns), window_(window) {
    stride_ = std::max<std::size_t>(1, window / kFine);
    const std::size_t rows = columns[0].size();
    for (const Moved& x : columns) {
      Range range;
      for (std::size_t back = 0; back < std::min(rows, 2 * window); back += stride_) range.add(x[rows - 1 - back]);
      const double scale = std::max(range.half(), columns.floor);
      weights_.push_back(1 / (scale * scale));
    }
  }

  // Misfit of a lag. kNoMatch if the data do not reach back far enough.
  [[nodiscard]] double at(std::size_t lag) const {
    const std::size_t rows = columns_[0].size();
    if (lag < 2 || window_ + lag > rows) return kNoMatch;
    columns_.pairs += columns_.size() * (window_ / stride_);
    double sum = 0;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const double* end = columns_[c].data() + rows - 1;
      double squares = 0;
      for (std::size_t back = 0; back < window_; back += stride_) {
        const double difference = *(end - back) - *(end - back - lag);
        squares += difference * difference;
      }
      sum += squares * weights_[c];
    }
    return sum;
  }

 private:
  const Columns& columns_;
  std::size_t window_;
  std::size_t stride_ = 1;
  std::vector<double> weights_;
};

// Period in samples near the lag `lag` of a grid with steps of `step`. 0 if the minimum is not inside the data.
double refine(const Columns& columns, std::size_t lag, std::size_t step) {
  const Misfit misfit(columns, lag);
  double here = misfit.at(lag);
  for (; step > 0; step /= 2) {
    for (bool better = true; better;) {
      better = false;
      for (const std::size_t next : {lag - std::min(lag, step), lag + step}) {
        const double there = misfit.at(next);
        if (there >= here) continue;
        lag = next;
        here = there;
        better = true;
        break;
      }
    }
  }
  const double below = misfit.at(lag - 1);
  const double above = misfit.at(lag + 1);
  if (below >= kNoMatch || above >= kNoMatch) return 0;
  const double bend = below - 2 * here + above;
  const double shift = bend > 0 ? 0.5 * (below - above) / bend : 0;
  return static_cast<double>(lag) + std::clamp(shift, -0.5, 0.5);
}

// Value of x between samples, from a cubic through four neighbours. The last sample takes the
// place of a neighbour behind it.
class Between {
 public:
  explicit Between(double lag) : whole_(static_cast<std::size_t>(lag)) {
    const double f = lag - static_cast<double>(whole_);
    weights_ = {-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2,
                (f + 1) * f * (f - 1) / 6};
    reach_ = whole_ + (f > 0 ? 1 : 0);
  }
  // Returns x(i + lag). Requires i + reach() < size.
  [[nodiscard]] double operator()(const Moved& x, std::size_t i) const {
    const std::size_t last = x.size() - 1;
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += weights_[k] * x[std::min(i + whole_ + k - 1, last)];
    return sum;
  }
  [[nodiscard]] std::size_t reach() const { return reach_; }

 private:
  std::size_t whole_, reach_ = 0;
  std::array<double, 4> weights_ = {};
};

// Error e(t) of one period (in samples) over all data.
class Repetition {
 public:
  Repetition(const Columns& columns, double period)
      : columns_(columns), later_(period), window_(static_cast<std::size_t>(std::lround(period))) {
    const std::size_t rows = columns[0].size();
    if (later_.reach() + window_ > rows) return;
    starts_ = rows - later_.reach() - window_ + 1;
    for (const Moved& x : columns) {
      Range range;
      for (std::size_t i = starts_ - 1; i < rows; ++i) range.add(x[i]);
      scales_.push_back(std::max(range.half(), columns.floor));
      moves_ = moves_ || range.half() > kStill;
    }
  }

  // Error in the last window. kNoMatch if there is no window or nothing moves.
  [[nodiscard]] double error() const {
    if (starts_ == 0 || !moves_) return kNoMatch;
    columns_.pairs += columns_.size() * window_;
    double worst = 0;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      double squares = 0;
      for (std::size_t i = starts_ - 1; i < starts_ - 1 + window_; ++i) squares += squared(c, i);
      worst = std::max(worst, std::sqrt(squares / static_cast<double>(window_)) / scales_[c]);
    }
    return worst;
  }

  // Earliest start of a window, in samples, from which on all windows repeat. The last window must repeat.
  [[nodiscard]] std::size_t from() const {
    std::size_t from = 0;
    std::vector<double> sums(starts_ + window_);  // sums of squares before each sample; a window is a difference of two sums
    columns_.pairs += columns_.size() * sums.size();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      for (std::size_t i = 0; i + 1 < sums.size(); ++i) sums[i + 1] = sums[i] + squared(c, i);
      const double limit = kMostCycleError * scales_[c];
      const double most = limit * limit * static_cast<double>(window_);
      std::size_t start = starts_ - 1;
      while (start > from && sums[start - 1 + window_] - sums[start - 1] < most) --start;
      from = std::max(from, start);
    }
    return from;
  }

 private:
  [[nodiscard]] double squared(std::size_t c, std::size_t i) const {
    const double difference = later_(columns_[c], i) - columns_[c][i];
    return difference * difference;
  }

  const Columns& columns_;
  Between later_;
  std::size_t window_;
  std::size_t starts_ = 0;  // number of possible windows
  std::vector<double> scales_ = {};
  bool moves_ = false;
};

struct Candidate {
  std::size_t lag = 0, step = 0;
  double error = kNoMatch;
};

// Best lag of each interval of promising lags, shortest first. Lags are computed one by one.
class Candidates {
 public:
  explicit Candidates(const Columns& columns) : rough_(columns), longest_(columns[0].size() / 2) {}

  std::optional<Candidate> next() {
    Candidate best;
    while (lag_ <= longest_) {
      step_ = std::max<std::size_t>(1, lag_ / kGrid);
      const double error = rough_.error(lag_, step_);
      if (error < best.error) best = {lag_, step_, error};
      lag_ += step_;
      if (error < kPromising && lag_ <= longest_) continue;
      if (best.error < kPromising) return best;
      best = {};
    }
    return {};
  }

 private:
  RoughError rough_;
  std::size_t longest_, lag_ = kShortest, step_ = 1;
};

}  // namespace

MotionCycle find_limit_cycle(std::span<const double> values, std::size_t columns, double sample_period) {
  MotionCycle best;
  if (columns == 0 || values.size() / columns < 2 * kShortest + 2) return best;
  const Columns split = columns_of(values, columns);
  if (split.empty()) return best;
  Candidates candidates(split);
  while (const std::optional<Candidate> candidate = candidates.next()) {
    const double period = refine(split, candidate->lag, candidate->step);
    if (period <= 0) continue;
    const Repetition repetition(split, period);
    const double error = repetition.error();
    if (error >= best.error) continue;
    best.period = period * sample_period;
    best.error = error;
    best.found = error < kMostCycleError;
    if (!best.found) continue;
    best.from = static_cast<double>(repetition.from()) * sample_period;
    break;
  }
  best.pairs = split.pairs;
  return best;
}

}  // namespace gaitlab
