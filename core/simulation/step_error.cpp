#include "core/simulation/step_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gaitlab {

StepError::StepError(const StateLayout& layout, std::vector<double> accuracy, std::vector<double> jumps)
    : layout_(layout),
      accuracy_(std::move(accuracy)),
      apart_(kDifferences),
      jumps_(std::move(jumps)),
      torque_(layout.joints * layout.lanes) {
  for (Interval* one : {&of_run_, &of_companion_}) {
    for (std::vector<double>* values : {&one->mean, &one->finest, &one->change}) values->assign(torque_.size(), 0.0);
    one->stops.assign(layout.lanes, 0.0);
  }
}

std::size_t StepError::size(const StateLayout& layout) {
  const std::size_t of_joints = layout.joints * layout.lanes;
  return layout.lanes + 5 * of_joints + kDifferences * (1 + 9 * of_joints);
}

void StepError::bind(Out numbers) {
  std::size_t at = 0;
  const auto cut = [&](std::size_t size) { return numbers.subspan(std::exchange(at, at + size), size); };
  sloped_ = cut(layout_.lanes);
  peaks_ = cut(torque_.size());
  const std::size_t size = torque_.size();
  run_ = {cut(size), cut(size), cut(size), cut(size)};
  for (Difference& one : apart_) {
    one = {cut(1), cut(size), cut(size), cut(size), cut(size), cut(size), {cut(size), cut(size), cut(size), cut(size)}};
  }
}

void StepError::add(const Course& course, In torque, double extrapolated, double finest) {
  for (std::size_t i = 0; i < torque.size(); ++i) {
    course.mean[i] += extrapolated * torque[i];
    course.finest[i] += finest * torque[i];
  }
}

/// Moves what `course` has collected since the last comparison into `interval`, and begins the next one.
void StepError::end(const Course& course, In torque, In speed, Interval& interval) const {
  std::ranges::copy(course.mean, interval.mean.begin());
  std::ranges::copy(course.finest, interval.finest.begin());
  std::ranges::fill(course.mean, 0.0);
  std::ranges::fill(course.finest, 0.0);
  std::ranges::fill(interval.stops, 0.0);
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    interval.change[i] = std::abs(torque[i] - course.torque[i]);
    course.torque[i] = torque[i];
    const double turn = static_cast<double>(speed[i] > 0) - static_cast<double>(speed[i] < 0);
    if (jumps_[i] > 0 && course.turn[i] != 0 && turn != course.turn[i]) interval.stops[i % layout_.lanes] = 1;
    course.turn[i] = turn;
  }
}

void StepError::see(In torque, In slope, In speed) {
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    torque_[i] = torque[i];
    peaks_[i] = std::max(peaks_[i], std::abs(torque[i]));
    if (slope[i] != 0) sloped_[i % layout_.lanes] = 1;
  }
  if (jumps()) end(run_, torque, speed, of_run_);
}

void StepError::compare(Companion which, In torque, double factor, double weight, double t, In speed) {
  const Difference& apart = of(which);
  const bool stops = jumps() && (which == Companion::twin || which == Companion::coarse);
  if (stops) end(apart.companion, torque, speed, of_companion_);
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const std::size_t lane = i % layout_.lanes;
    double difference = factor * std::abs(torque_[i] - torque[i]);
    if (difference != 0 && which == Companion::twin) sloped_[lane] = 1;
    if (stops && of_run_.stops[lane] + of_companion_.stops[lane] > 0) {
      const double jump = std::max(of_run_.change[i], of_companion_.change[i]);
      const double mean =
          std::min(std::abs(of_run_.mean[i] - of_companion_.mean[i]), std::abs(of_run_.finest[i] - of_companion_.finest[i]));
      difference = std::sqrt(factor * jump * mean);
    }
    apart.squares[i] += weight * difference * difference;
  }
  apart.count[0] += weight;
  // The stop of a joint at another time is not an event.
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
