#include "core/simulation/step_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gaitlab {

StepError::StepError(const Actuator& actuator, const StateLayout& layout, std::vector<double> accuracy)
    : actuator_(actuator), layout_(layout), accuracy_(std::move(accuracy)) {
  for (auto* values : {&torque_, &twin_torque_, &slope_}) values->resize(layout.joints * layout.lanes);
}

std::size_t StepError::size(const StateLayout& layout) { return 1 + 3 * layout.lanes + 2 * layout.joints * layout.lanes; }

void StepError::bind(Out numbers) {
  std::size_t at = 0;
  const auto cut = [&](std::size_t size) { return numbers.subspan(std::exchange(at, at + size), size); };
  count_ = cut(1);
  for (Out* of_lanes : {&sloped_, &event_, &event_joint_}) *of_lanes = cut(layout_.lanes);
  for (Out* of_joints : {&squares_, &peaks_}) *of_joints = cut(torque_.size());
}

void StepError::see(In command, In speeds) {
  actuator_.effort(command, speeds, torque_, slope_);
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    peaks_[i] = std::max(peaks_[i], std::abs(torque_[i]));
    if (slope_[i] != 0) sloped_[i % layout_.lanes] = 1;
  }
}

void StepError::compare(In command, In speeds, double factor, double weight, double t) {
  actuator_.effort(command, speeds, twin_torque_, slope_);
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const double apart = factor * (torque_[i] - twin_torque_[i]);
    squares_[i] += weight * apart * apart;
    if (apart != 0) sloped_[i % layout_.lanes] = 1;
  }
  count_[0] += weight;
  for (std::size_t lane = 0; lane < layout_.lanes; ++lane) {
    if (!(event_[lane] > 0)) look_for_event(lane, factor, t);
  }
}

void StepError::look_for_event(std::size_t lane, double factor, double t) {
  double largest = 0;
  for (std::size_t i = lane; i < peaks_.size(); i += layout_.lanes) largest = std::max(largest, peaks_[i]);
  double worst = accuracy_[lane];
  for (std::size_t j = 0; j < layout_.joints && largest > 0; ++j) {
    const std::size_t i = j * layout_.lanes + lane;
    const double apart = factor * std::abs(torque_[i] - twin_torque_[i]) / std::max(peaks_[i], kLeastPeak * largest);
    if (apart <= worst) continue;
    worst = apart;
    event_[lane] = 1 + t;
    event_joint_[lane] = static_cast<double>(j);
  }
}

double StepError::rms(std::size_t joint, std::size_t lane) const {
  return any(lane) && count_[0] > 0 ? std::sqrt(squares_[joint * layout_.lanes + lane] / count_[0]) : 0;
}

}  // namespace gaitlab
