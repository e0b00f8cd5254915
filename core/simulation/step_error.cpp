#include "core/simulation/step_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gaitlab {

namespace {

/// Steps of h in as many control periods as last for `seconds`.
std::int64_t whole_periods(double seconds, double h, std::int64_t control_every) {
  const double periods = seconds / (h * static_cast<double>(control_every));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(periods - 1e-9))) * control_every;
}

}  // namespace

StepError::StepError(std::unique_ptr<Plant> twin, const StepTwin& how, const Actuator& actuator, const StateLayout& layout,
                     std::int64_t control_every, double h)
    : twin_(std::move(twin)),
      how_(how),
      actuator_(actuator),
      layout_(layout),
      window_(whole_periods(how.window, h, control_every)),
      cycle_(how.cycle * window_),
      settle_(whole_periods(kGrowth, h, control_every)),
      stride_(1) {
  for (std::int64_t n = 1; n <= control_every; ++n) {
    if (control_every % n == 0 && static_cast<double>(n) * h <= kApart * (1 + 1e-9)) stride_ = n;
  }
  for (auto* values : {&torque_, &twin_torque_, &slope_}) values->resize(layout.joints * layout.lanes);
}

std::size_t StepError::size(const StateLayout& layout, std::size_t history) {
  return 1 + layout.lanes + layout.size() + history + 2 * layout.joints * layout.lanes;
}

void StepError::bind(Out numbers) {
  std::size_t at = 0;
  const auto cut = [&](std::size_t size) { return numbers.subspan(std::exchange(at, at + size), size); };
  count_ = cut(1);
  sloped_ = cut(layout_.lanes);
  state_ = cut(layout_.size());
  history_ = cut(twin_->history());
  squares_ = cut(torque_.size());
  peaks_ = cut(torque_.size());
  twin_->bind(state_, history_);
}

void StepError::begin(std::int64_t step, In state, In history) {
  if (step % cycle_ != 0) return;
  std::ranges::copy(state, state_.begin());
  std::ranges::copy(history, history_.begin());
}

void StepError::follow(std::int64_t step, In state, In command, double h) {
  const std::int64_t at = step % cycle_;
  const auto speeds = [&](In of) { return of.subspan(layout_.speeds(), torque_.size()); };
  const bool asked = (at + 1) % stride_ == 0;
  if (asked) {
    actuator_.effort(command, speeds(state), torque_, slope_);
    for (std::size_t i = 0; i < torque_.size(); ++i) peaks_[i] = std::max(peaks_[i], std::abs(torque_[i]));
  }
  if (at >= window_) return;
  if (how_.steps > 1) {
    if (at % how_.steps != how_.steps - 1) return;
    twin_->advance(command, how_.steps * h);
  } else {
    for (int i = 0; i < -how_.steps; ++i) twin_->advance(command, h / -how_.steps);
    if (how_.steps == 1) twin_->advance(command, h);
  }
  const bool grows = at < settle_ && step >= cycle_;  // from equal states; at the start they are equal in truth
  if (grows || !asked) return;
  actuator_.effort(command, speeds(state_), twin_torque_, slope_);
  const double weight = step < cycle_ ? kStart : 1;
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const double apart = torque_[i] - twin_torque_[i];
    squares_[i] += weight * apart * apart;
    if (slope_[i] != 0 || apart != 0) sloped_[i % layout_.lanes] = 1;
  }
  count_[0] += weight;
}

double StepError::rms(std::size_t joint, std::size_t lane) const {
  return any(lane) ? how_.factor * std::sqrt(squares_[joint * layout_.lanes + lane] / count_[0]) : 0;
}

}  // namespace gaitlab
