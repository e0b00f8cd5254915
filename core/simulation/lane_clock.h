// Schedule of a rollout: control ticks, trace rows and end, in steps of the simulation.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/periods.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Control ticks are at whole steps. Trace rows and the end of the rollout are also at whole steps if the step is fixed, but
/// may be within a step if the integrator is adaptive. Times are in s.
class LaneClock {
 public:
  /// If `rows` is false, only the end is recorded.
  explicit LaneClock(const Scenario& s, bool rows = true)
      : step_(s.physics.step),
        duration_(s.duration / step_),
        period_(rows ? s.trace.period / step_ : std::numeric_limits<double>::infinity()),
        control_every_(math::steps_in(s.control_period, step_)) {
    if (s.physics.adaptive_step) return;
    duration_ = std::round(duration_);  // the check of the scenario ensures a whole number, exact to 1e-9
    period_ = std::round(period_);
  }

  /// Number of steps until the end, including a shortened last step.
  [[nodiscard]] std::int64_t steps() const { return static_cast<std::int64_t>(std::ceil(duration_ - kSame)); }
  [[nodiscard]] bool commands(std::int64_t step) const { return step < steps() && at_tick(step); }
  [[nodiscard]] bool at_tick(std::int64_t step) const { return step % control_every_ == 0; }
  /// Number of the control tick at a step. The step must be a control tick.
  [[nodiscard]] std::int64_t tick(std::int64_t step) const { return step / control_every_; }
  /// True if the rollout ends after `step` steps.
  [[nodiscard]] bool ends(std::int64_t step) const { return std::abs(duration_ - static_cast<double>(step)) <= kSame; }
  [[nodiscard]] bool records(std::int64_t step) const {
    const double at = static_cast<double>(step);
    if (at > duration_ + kSame) return false;
    return ends(step) || std::abs(std::round(at / period_) * period_ - at) <= kSame;
  }
  /// Time of the next trace row, or of the end of the rollout, in s after the start of step `step`. The time is later than
  /// `after` and before the end of the step; infinity if there is none. It is rounded to a picosecond, so that rows at one time
  /// have the same bits for every trace period of which the time is a multiple.
  [[nodiscard]] double row_within(std::int64_t step, double after) const {
    const double from = static_cast<double>(step) + after / step_;
    const double row = (std::floor(from / period_ + kSame) + 1) * period_;
    const double at = duration_ > from + kSame && duration_ < row + kSame ? duration_ : row;
    const double within = at - static_cast<double>(step);
    if (within > 1 - kSame || at > duration_ + kSame) return std::numeric_limits<double>::infinity();
    return std::round(at * step_ * kPicoseconds) / kPicoseconds - static_cast<double>(step) * step_;
  }
  /// True if the rollout ends `within` seconds after the start of step `step`.
  [[nodiscard]] bool ends_within(std::int64_t step, double within) const {
    return std::abs(static_cast<double>(step) + within / step_ - duration_) <= kSame;
  }

 private:
  static constexpr double kSame = 1e-7;         ///< steps; more than the rounding error of 1e8 steps
  static constexpr double kPicoseconds = 1e12;  ///< picoseconds per second

  double step_, duration_, period_;  ///< step_ in s, the others in steps
  std::int64_t control_every_;
};

}  // namespace gaitlab
