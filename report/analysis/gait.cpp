#include "report/analysis/gait.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/scenario/change_section.h"
#include "report/analysis/cpg_alone.h"
#include "report/analysis/motion.h"

namespace gaitlab::report {

namespace {

constexpr double kStill = 2e-3;       // rad or rad/s: a smaller range counts as 0 (core/recording/limit_cycle.h)
constexpr double kTwoPeriods = 2.25;  // least length that shows a period, in periods
constexpr double kLeastSamples = 20;  // least number of rows in a stretch that is compared
constexpr double kFar = std::numeric_limits<double>::infinity();

/// True if the set points of the run's last period equal those of the period before, or if less than two periods follow
/// `full_size`, s. A chirp may seem to repeat after the run.
bool repeats_in_run(const LookAhead& ahead, double period, double full_size, double spacing) {
  const std::size_t columns = ahead.after_run.size();
  const std::size_t rows = ahead.in_run.size() / columns;
  const auto lag = static_cast<std::size_t>(std::lround(period / spacing));
  if (static_cast<double>(rows) < full_size / spacing + 2 * static_cast<double>(lag)) return true;
  double largest = 0;
  std::vector<double> misfit;
  for (std::size_t c = 0; c < columns; ++c) {
    double squares = 0;
    double low = kFar;
    double high = -kFar;
    for (std::size_t k = rows - lag; k < rows; ++k) {
      const double now = ahead.in_run[k * columns + c];
      const double before = ahead.in_run[(k - lag) * columns + c];
      squares += (now - before) * (now - before);
      low = std::min({low, now, before});
      high = std::max({high, now, before});
    }
    largest = std::max(largest, (high - low) / 2);
    misfit.push_back(std::sqrt(squares / static_cast<double>(lag)));
  }
  // If the period is not a whole number of ticks, the samples are shifted by a fraction of a tick.
  const double shift = std::numbers::pi * spacing / period;
  return *std::ranges::max_element(misfit) <= (kMostCycleError + shift) * std::max(largest, kStill);
}

/// Time of the landing, s: after it the mean of the ground's normal force over any `span` s is at least half of the weight. 0
/// if the forces are not known, or too small at the end of the run.
double carried_from(const Scenario& s, const Recording& r, double span) {
  const Series load = ground_load(s, r);
  const Series t = motion(r).t;
  const double least = kBorne * s.robot->mass * s.physics.gravity.norm();
  if (load.empty() || t.size() < 2 || !(least > 0)) return 0;
  std::vector<double> impulse{0};  // N s, from the start on
  for (std::size_t k = 1; k < t.size(); ++k) impulse.push_back(impulse.back() + load[k] * (t[k] - t[k - 1]));
  std::size_t last = t.size() - 1;
  bool ever = false;
  for (std::size_t k = last; k-- > 0;) {
    while (last > k && t[last] - t[k] > span * (1 + 1e-9)) --last;
    if (t.back() - t[k] < span) continue;
    const bool carried = impulse[last] - impulse[k] >= least * (t[last] - t[k]);
    if (!carried) return ever ? t[k + 1] : 0;
    ever = true;
  }
  return 0;
}

double period_of(const Scenario& s, const Recording& r, double stated, Gait& made) {
  const MotionCycle seen = set_point_cycle(s, r);
  made.ahead = look_ahead(s, r, seen.found ? seen.period : 0, stated);
  if (seen.found) return seen.period;
  if (const LookAhead* const ahead = made.ahead.get(); ahead != nullptr && ahead->cycle.found) {
    const double found = ahead->cycle.period;
    if (repeats_in_run(*ahead, found, made.full_size, s.control_period)) return found;
    // Oscillators that still synchronise will repeat with the period that they state; a chirp states none.
    return std::abs(found - stated) <= s.control_period ? stated : 0;
  }
  if (made.ahead != nullptr) return made.ahead->until < kTwoPeriods * stated ? stated : 0;
  // The recorded set points of a run of several periods would have shown the stated period.
  return r.simulated - last_change(s, r.simulated) < kPeriodsNeeded * stated ? stated : 0;
}

/// Mean and RMS of a joint from one time to another.
struct Level {
  double mean = 0, rms = 0;
};

/// Values of the recorded set points, or of their speeds, joined by straight lines.
class Values {
 public:
  Values(const Series& time, const Series& points, bool rates) : t_(time) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::size_t before = k == 0 ? 0 : k - 1;
      const double span = std::max(time[k] - time[before], kShortest);
      values_.push_back(rates ? (points[k] - points[before]) / span : points[k]);
    }
  }
  /// Range in the rows from `from` on, and the largest difference of two rows.
  [[nodiscard]] std::pair<double, double> range(double from) const {
    double low = kFar;
    double high = -kFar;
    double jump = 0;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      if (t_[k] < from) continue;
      low = std::min(low, values_[k]);
      high = std::max(high, values_[k]);
      if (k > 0) jump = std::max(jump, std::abs(values_[k] - values_[k - 1]));
    }
    return {std::max(0.0, high - low), jump};
  }
  [[nodiscard]] Level level(double from, double to) const {
    Level sum;
    for (std::size_t k = 1; k < values_.size(); ++k) {
      const double a = std::max(from, t_[k - 1]);
      const double b = std::min(to, t_[k]);
      if (!(b > a)) continue;
      const double x = at(k, a);
      const double y = at(k, b);
      sum.mean += (b - a) * (x + y) / 2;
      sum.rms += (b - a) * (x * x + x * y + y * y) / 3;
    }
    return {sum.mean / (to - from), std::sqrt(sum.rms / (to - from))};
  }

 private:
  static constexpr double kShortest = 1e-12;  // s
  [[nodiscard]] double at(std::size_t k, double t) const {
    const double share = (t - t_[k - 1]) / (t_[k] - t_[k - 1]);
    return values_[k - 1] + share * (values_[k] - values_[k - 1]);
  }

  const Series& t_;
  std::vector<double> values_ = {};
};

std::vector<std::string> driven_names(const Robot& robot) {
  std::vector<std::string> all;
  for (const Joint& joint : robot.joints) {
    if (joint.driven()) all.push_back(joint.name);
  }
  return all;
}

/// Growth after the run of the joint whose range grows most.
std::string grows(const Scenario& s, const Judged& judged, const Gait& gait) {
  const LookAhead& ahead = *gait.ahead;
  const std::size_t columns = ahead.after_run.size();
  const std::vector<bool> free = turning_freely(*s.robot);
  // The samples of three periods may be nearer to a peak than those of one period, which is not growth.
  const double sampled =
      gait.period > 0 ? (1 - std::cos(std::min(std::numbers::pi, std::numbers::pi * s.control_period / gait.period))) / 2 : 0;
  const auto first = static_cast<std::size_t>(std::ceil(judged.from / s.control_period - 1e-6));
  double most = 0;
  std::string text;
  for (std::size_t c = 0; c < columns; ++c) {
    const auto [low, high] =
        extremes(ahead.in_run, columns, c, first, ahead.in_run.size() / columns, free[c], s.control_period);
    const double range = high - low;
    const double more = std::max(ahead.after_run[c].second, high) - std::min(ahead.after_run[c].first, low) - range;
    const double share = more / std::max(range, kStill);
    if (!(more > kStill / 2) || !(share > Gait::kMostGrowth + sampled) || !(share > most)) continue;
    most = share;
    text = fmt::format(
        "the set points still grow: those of joint {} range over {:.3g} {} in the judged time and over {:.3g} later; "
        "take a longer duration",
        driven_names(*s.robot)[c], range, free[c] ? "rad/s" : "rad", range + more);
  }
  return text;
}

/// Recorded set points of the joints, or their speeds for hinges without range, for a comparison of periods.
class Periods {
 public:
  Periods(const Scenario& s, const Recording& r, double period) : t_(motion(r).t), free_(turning_freely(*s.robot)) {
    const std::vector<Series> recorded = set_points(s, r);
    if (!(period > 0) || t_.size() < 2) return;
    spacing_ = t_[1] - t_[0];
    unit_ = std::ceil(kLeastSamples * spacing_ / period) * period;
    for (std::size_t c = 0; c < recorded.size(); ++c) joints_.emplace_back(t_, recorded[c], free_[c]);
  }
  /// Length of whole periods with at least kLeastSamples rows, s; 0 if nothing is known.
  [[nodiscard]] double unit() const { return unit_; }

  struct Change {
    std::size_t column = 0;  ///< column of the joint that changes most
    double mean = 0, rms = 0, range = 0;
    double over = 0;  ///< largest change / allowed change
  };
  /// Change between the stretch that ends at `to` and the one that ends `back` s earlier. `share` of the range from `from` on
  /// is allowed, and in addition one row of the largest jump, because a period may not be a whole number of rows.
  [[nodiscard]] Change change(double back, double from, double to, double share) const {
    Change most;
    for (std::size_t c = 0; c < joints_.size(); ++c) {
      const auto [range, jump] = joints_[c].range(from);
      const Level last = joints_[c].level(to - unit_, to);
      const Level early = joints_[c].level(to - unit_ - back, to - back);
      const double allowed = share * std::max(range, kStill) + jump * spacing_ / unit_;
      const Change own{c, last.mean - early.mean, last.rms - early.rms, range,
                       std::max(std::abs(last.mean - early.mean), std::abs(last.rms - early.rms)) / allowed};
      if (own.over > most.over) most = own;
    }
    return most;
  }
  [[nodiscard]] bool free(std::size_t column) const { return free_[column]; }

 private:
  Series t_;
  std::vector<bool> free_;
  std::vector<Values> joints_ = {};
  double spacing_ = 0, unit_ = 0;
};

/// Difference between the first and the last period of the window, for the joint that changes most.
std::string drifts(const Scenario& s, const Recording& r, double from, double to, double period) {
  const Periods periods(s, r, period);
  const double unit = periods.unit();
  const double between = unit > 0 ? std::floor((to - from) / unit - 1 + 1e-3) * unit : 0;
  if (!(between > 0)) return "";
  const Periods::Change most = periods.change(between, from, to, Gait::kMostDrift);
  if (!(most.over > 1)) return "";
  const bool moves = std::abs(most.mean) >= std::abs(most.rms);
  const char* const of_unit = periods.free(most.column) ? "rad/s" : "rad";
  return fmt::format("the set points {}: {} of joint {} changes by {:.2g} {} per period of {:.3g} s, with a range of {:.3g} {}",
                     moves          ? "drift"
                     : most.rms > 0 ? "grow"
                                    : "shrink",
                     moves ? "the mean" : "the RMS", driven_names(*s.robot)[most.column],
                     (moves ? most.mean : most.rms) * period / between, of_unit, period, most.range, of_unit);
}

/// Time from which the recorded set points have the size of their last period, s. It is for CPGs that state none, such as
/// equations that lower the robot and then repeat. 0 if they have this size from `start` on, or change until the end. A slow
/// drift does not count: later periods are equal within a tenth of Gait::kMostDrift, and one of the two periods before them
/// differs by more than Gait::kMostDrift.
double settled_from(const Scenario& s, const Recording& r, double start, double period) {
  const Periods periods(s, r, period);
  const double unit = periods.unit();
  const double to = r.simulated;
  const double held = unit > 0 ? std::floor((to - start) / unit + 1e-3) : 0;
  if (held < 3) return 0;
  const auto differs = [&](double back, double share) { return periods.change(back * unit, to - unit, to, share).over > 1; };
  if (!differs(held - 2, Gait::kMostDrift)) return 0;
  double equal = 1;
  while (equal < held - 1 && !differs(equal, Gait::kMostDrift / 10)) ++equal;
  const bool apart = differs(equal, Gait::kMostDrift) || differs(std::min(equal + 1, held - 1), Gait::kMostDrift);
  return equal >= 2 && apart ? to - equal * unit : 0;
}

/// Sets the start of a gait with a known period and full size, in a run that ends at `end`, s.
void find_start(const Scenario& s, const Recording& r, double end, double ramp, Gait& made) {
  const double carried = made.period > 0 ? carried_from(s, r, made.period) : 0;
  made.start = std::max({last_change(s, end), ramp < end ? ramp : 0, carried});
  if (!(made.full_size > 0)) made.start = std::max(made.start, settled_from(s, r, made.start, made.period));
}

}  // namespace

Gait gait(const Scenario& s, const Recording& r) {
  Gait made;
  const StatedTimes stated = stated_times(s);
  made.full_size = stated.full_size;
  if (s.cpg.entry != nullptr) made.period = period_of(s, r, stated.period, made);
  find_start(s, r, r.simulated, stated.ramp, made);
  return made;
}

Gait gait_so_far(const Scenario& s, const Recording& so_far) {
  const StatedTimes stated = stated_times(s);
  Gait made{.period = stated.by_cpg ? stated.period : 0, .full_size = stated.full_size};
  find_start(s, so_far, s.duration, stated.ramp, made);
  return made;
}

std::string growth(const Scenario& s, const Recording& r, const Judged& judged, const Gait& gait) {
  if (gait.full_size > r.simulated) {
    const double needed = gait.full_size + kPeriodsNeeded * gait.period;
    return fmt::format(
        "the set points still grow: they reach their full size at {:.4g} s, but the run ends at {:.4g} s; take "
        "{}",
        gait.full_size, r.simulated, std::isfinite(needed) ? fmt::format("duration: {:.4g}", needed) : "another rate");
  }
  if (gait.ahead != nullptr && !(gait.full_size > 0)) {
    if (std::string text = grows(s, judged, gait); !text.empty()) return text;
  }
  return drifts(s, r, std::max(judged.from, gait.full_size), judged.to, gait.period);
}

}  // namespace gaitlab::report
