#include "core/simulation/step_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gaitlab {

StepError::StepError(const StateLayout& layout, std::vector<double> accuracy)
    : layout_(layout), accuracy_(std::move(accuracy)), apart_(kDifferences), torque_(layout.joints * layout.lanes) {}

std::size_t StepError::size(const StateLayout& layout) {
  const std::size_t of_joints = layout.joints * layout.lanes;
  return layout.lanes + of_joints + kDifferences * (1 + 5 * of_joints);
}

void StepError::bind(Out numbers) {
  std::size_t at = 0;
  const auto cut = [&](std::size_t size) { return numbers.subspan(std::exchange(at, at + size), size); };
  sloped_ = cut(layout_.lanes);
  peaks_ = cut(torque_.size());
  for (Difference& one : apart_) {
    const std::size_t size = torque_.size();
    one = {cut(1), cut(size), cut(size), cut(size), cut(size), cut(size)};
  }
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
    const double least = least_peak(lane);
    for (std::size_t i = lane; i < torque_.size(); i += layout_.lanes)
      look_for_event(apart, i, factor * std::abs(torque_[i] - torque[i]), least, t);
  }
}

/// Least peak torque that counts in a lane, N m: the share kLeastPeak of the largest torque of the lane.
double StepError::least_peak(std::size_t lane) const {
  double largest = 0;
  for (std::size_t i = lane; i < peaks_.size(); i += layout_.lanes) largest = std::max(largest, peaks_[i]);
  return kLeastPeak * largest;
}

void StepError::look_for_event(const Difference& apart, std::size_t i, double difference, double least, double t) {
  if (difference > apart.largest[i]) {
    apart.largest[i] = difference;
    apart.largest_time[i] = t;
  }
  const double event = least_event(i, least);
  if (!(apart.event[i] <= event && apart.largest[i] > event)) return;
  apart.event[i] = apart.largest[i];
  apart.event_time[i] = apart.largest_time[i];
}

/// RMS, since the start, of factor times torque difference of a joint, N m. 0 before the first comparison.
double StepError::rms(Companion which, std::size_t joint, std::size_t lane) const {
  const Difference& apart = of(which);
  return apart.count[0] > 0 ? std::sqrt(apart.squares[joint * layout_.lanes + lane] / apart.count[0]) : 0;
}

Parting StepError::parting(Companion which, std::size_t lane) const {
  const double least = least_peak(lane);
  const Difference& apart = of(which);
  Parting made;
  for (std::size_t j = 0; j < layout_.joints && least > 0; ++j) {
    const std::size_t i = j * layout_.lanes + lane;
    made.share = std::max(made.share, rms(which, j, lane) / std::max(peaks_[i], least));
    const bool lasting = apart.event[i] > least_event(i, least);
    if (!lasting && !(apart.largest[i] > least_event(i, least))) continue;
    const double time = lasting ? apart.event_time[i] : apart.largest_time[i];
    if (made.time >= 0 && time >= made.time) continue;
    made.time = time;
    made.joint = j;
  }
  return made;
}

void StepError::put(std::size_t lane, StepTally& tally) const {
  tally.estimated = sloped_[lane] > 0;
  if (!tally.estimated) return;
  const Parting finer = parting(Companion::twin, lane);
  const Parting coarser = parting(Companion::coarse, lane);
  const bool first = coarser.time < 0 || (finer.time >= 0 && finer.time <= coarser.time);
  tally.event = first ? finer : coarser;
  tally.chaotic = parting(Companion::chaotic, lane);
  tally.ill = parting(Companion::ill, lane);
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    tally.torque_error[j] = std::max(rms(Companion::twin, j, lane), rms(Companion::coarse, j, lane));
    tally.torque_peak[j] = peaks_[j * layout_.lanes + lane];
  }
}

}  // namespace gaitlab
