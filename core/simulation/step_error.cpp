#include "core/simulation/step_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gaitlab {

StepError::StepError(const StateLayout& layout, std::vector<double> accuracy)
    : layout_(layout), accuracy_(std::move(accuracy)), apart_(kDifferences), torque_(layout.joints * layout.lanes) {}

std::size_t StepError::size(const StateLayout& layout) {
  const std::size_t of_joints = layout.joints * layout.lanes;
  return layout.lanes + of_joints + kDifferences * (1 + 2 * layout.lanes + of_joints);
}

void StepError::bind(Out numbers) {
  std::size_t at = 0;
  const auto cut = [&](std::size_t size) { return numbers.subspan(std::exchange(at, at + size), size); };
  sloped_ = cut(layout_.lanes);
  peaks_ = cut(torque_.size());
  for (Difference& one : apart_) one = {cut(1), cut(layout_.lanes), cut(layout_.lanes), cut(torque_.size())};
}

void StepError::see(In torque, In slope) {
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    torque_[i] = torque[i];
    peaks_[i] = std::max(peaks_[i], std::abs(torque[i]));
    if (slope[i] != 0) sloped_[i % layout_.lanes] = 1;
  }
}

void StepError::compare(Companion which, In torque, double factor, double weight, double t) {
  const Difference& apart = of(which);
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const double difference = factor * (torque_[i] - torque[i]);
    apart.squares[i] += weight * difference * difference;
    if (difference != 0 && which == Companion::twin) sloped_[i % layout_.lanes] = 1;
  }
  apart.count[0] += weight;
  for (std::size_t lane = 0; lane < layout_.lanes; ++lane) {
    if (!(apart.time[lane] > 0)) look_for_event(apart, torque, lane, factor, t);
  }
}

/// Of the lane's largest torque: less is no peak.
double StepError::least_peak(std::size_t lane) const {
  double largest = 0;
  for (std::size_t i = lane; i < peaks_.size(); i += layout_.lanes) largest = std::max(largest, peaks_[i]);
  return kLeastPeak * largest;
}

void StepError::look_for_event(const Difference& apart, In torque, std::size_t lane, double factor, double t) {
  const double least = least_peak(lane);
  double worst = accuracy_[lane];
  for (std::size_t j = 0; j < layout_.joints && least > 0; ++j) {
    const std::size_t i = j * layout_.lanes + lane;
    const double share = factor * std::abs(torque_[i] - torque[i]) / std::max(peaks_[i], least);
    if (share <= worst) continue;
    worst = share;
    apart.time[lane] = 1 + t;
    apart.joint[lane] = static_cast<double>(j);
  }
}

/// RMS of factor x difference of a joint so far, N m; 0 before the first comparison.
double StepError::rms(Companion which, std::size_t joint, std::size_t lane) const {
  const Difference& apart = of(which);
  return apart.count[0] > 0 ? std::sqrt(apart.squares[joint * layout_.lanes + lane] / apart.count[0]) : 0;
}

Parting StepError::parting(Companion which, std::size_t lane) const {
  const double least = least_peak(lane);
  Parting made{of(which).time[lane] - 1, static_cast<std::size_t>(of(which).joint[lane])};
  for (std::size_t j = 0; j < layout_.joints && least > 0; ++j)
    made.share = std::max(made.share, rms(which, j, lane) / std::max(peaks_[j * layout_.lanes + lane], least));
  return made;
}

void StepError::put(std::size_t lane, StepTally& tally) const {
  tally.estimated = sloped_[lane] > 0;
  if (!tally.estimated) return;
  const Parting finer = parting(Companion::twin, lane);
  const Parting coarser = parting(Companion::coarse, lane);
  tally.event = finer.share >= coarser.share ? finer : coarser;
  tally.chaotic = parting(Companion::chaotic, lane);
  tally.ill = parting(Companion::ill, lane);
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    tally.torque_error[j] = std::max(rms(Companion::twin, j, lane), rms(Companion::coarse, j, lane));
    tally.torque_peak[j] = peaks_[j * layout_.lanes + lane];
  }
}

}  // namespace gaitlab
