#include "core/recording/judged.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace gaitlab {

namespace {

constexpr double kLongestStart = 2;    // s; longest start that is left out
constexpr double kShareOfStart = 0.2;  // longest start that is left out, as a share of the run
constexpr double kWholePeriod = 1e-3;  // tolerance of a whole period, as a share of a period
constexpr double kSameInstant = 1e-9;  // s

void window(Judged& judged, double end, const MotionCycle& cycle, double period, double start) {
  judged.to = end;
  const double left = std::max(0.0, end - start);
  const double length = cycle.found ? cycle.period : period;
  if (!(length > 0)) return;
  const double whole = std::floor(left / length + kWholePeriod);
  if (whole < 2) {
    judged.from = end - left + left_out_start(left);
    return;
  }
  const double held = whole - 1;
  judged.from = std::max(0.0, end - held * length);
  if (cycle.found) judged.periods = static_cast<std::size_t>(held);
}

/// Last row whose time is at most `time` + `within`.
std::size_t row_at(const Series& t, double time, double within) {
  std::size_t row = 0;
  while (row + 1 < t.size() && t[row + 1] <= time + within) ++row;
  return row;
}

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Largest value in the rows after `first`, and its time. NaN if no value is known.
std::pair<double, double> peak_of(const Series& t, const Series& values, std::size_t first) {
  if (values.empty() || std::isnan(values.back())) return {kNotKnown, kNotKnown};
  std::pair<double, double> largest{0, 0};
  for (std::size_t k = first + 1; k < t.size(); ++k) {
    if (values[k] > kLarger * largest.first) largest = {values[k], t[k]};
  }
  return largest;
}

JudgedJoint from_ticks(const Recording& record, std::size_t joint, std::size_t first) {
  const auto column = [&](TickColumn which) { return record.tick(joint, which); };
  const Series t(record.ticks, 0);
  const Series torque = column(kTorquePeak);
  const Series limit = column(kPeakLimit);
  const Series voltage = column(kVoltageLimited);
  const Series current = column(kCurrentLimited);
  JudgedJoint j;
  for (std::size_t k = first + 1; k < t.size(); ++k) {
    if (torque[k] > kLarger * j.torque_peak) {
      j.torque_peak = torque[k];
      j.torque_peak_time = t[k];
      j.peak_limit = motor_limit(limit[k]);
    }
    if (j.reaches_limit()) continue;
    if (voltage[k] > voltage[k - 1]) j.first_limit = MotorLimit::voltage;
    if (current[k] > current[k - 1]) j.first_limit = MotorLimit::current;
    if (!j.reaches_limit()) j.first_limit = motor_limit(limit[k]);
    // The time at the limit is assumed to be the last part of the time between two rows.
    j.first_limit_time = t[k] - std::max(voltage[k] - voltage[k - 1], current[k] - current[k - 1]);
  }
  if (torque.empty() || std::isnan(torque.back())) j.torque_peak = j.torque_peak_time = kNotKnown;
  std::tie(j.error_peak, j.error_peak_time) = peak_of(t, column(kErrorPeak), first);
  std::tie(j.envelope_peak, j.envelope_peak_time) = peak_of(t, column(kEnvelopePeak), first);
  std::tie(j.speed_peak, j.speed_peak_time) = peak_of(t, column(kSpeedPeak), first);
  j.voltage_peak = peak_of(t, column(kVoltagePeak), first).first;
  j.current_peak = peak_of(t, column(kCurrentPeak), first).first;
  const double span = t.back() - t[first];
  if (!(span > 0)) return j;
  const auto rms = [&](const Series& sum) {
    const double grown = sum.empty() ? kNotKnown : sum.back() - sum[first];
    return std::isnan(grown) ? kNotKnown : std::sqrt(std::max(0.0, grown) / span);
  };
  j.current_rms = rms(column(kCurrentSquare));
  j.torque_rms = rms(column(kTorqueSquare));
  j.voltage_limited = (voltage.back() - voltage[first]) / span;
  j.current_limited = (current.back() - current[first]) / span;
  return j;
}

/// Joint with the largest value. If several are equal, the first of them.
std::size_t most(const std::vector<JudgedJoint>& joints, double JudgedJoint::*member) {
  std::size_t found = 0;
  for (std::size_t j = 1; j < joints.size(); ++j) {
    if (joints[j].*member > kLarger * (joints[found].*member)) found = j;
  }
  return found;
}

/// Computes the statistics of a window. Its first row may be later than its start by `within` s.
void measure_window(const Recording& r, double within, Judged& judged) {
  judged.joints.resize(r.ticked());
  judged.whole.resize(r.ticked());
  const bool known = r.ticked() > 0 && !r.tick(0, kCurrentLimited).empty();
  if (r.ticks.rows() > 0) judged.first_row = row_at(Series(r.ticks, 0), judged.from, std::max(kSameInstant, within));
  for (std::size_t j = 0; known && j < r.ticked(); ++j) {
    judged.joints[j] = from_ticks(r, j, judged.first_row);
    judged.whole[j] = from_ticks(r, j, 0);
  }
  judged.order.resize(judged.joints.size());
  std::iota(judged.order.begin(), judged.order.end(), 0);
  std::stable_sort(judged.order.begin(), judged.order.end(), [&](std::size_t a, std::size_t b) {
    const JudgedJoint& one = judged.joints[a];
    const JudgedJoint& other = judged.joints[b];
    return std::tuple(one.limited(), one.torque_rms, one.torque_peak) >
           std::tuple(other.limited(), other.torque_rms, other.torque_peak);
  });
}

}  // namespace

std::size_t Judged::limited(const std::vector<JudgedJoint>& joints) {
  return static_cast<std::size_t>(
      std::count_if(joints.begin(), joints.end(), [](const JudgedJoint& j) { return j.reaches_limit(); }));
}

std::size_t Judged::farthest(const std::vector<JudgedJoint>& joints) { return most(joints, &JudgedJoint::error_peak); }

std::size_t Judged::strongest(const std::vector<JudgedJoint>& joints) { return most(joints, &JudgedJoint::torque_peak); }

std::size_t Judged::first(const std::vector<JudgedJoint>& joints) {
  const auto earlier = [](const JudgedJoint& a, const JudgedJoint& b) {
    return a.reaches_limit() && (!b.reaches_limit() || a.first_limit_time < b.first_limit_time);
  };
  return static_cast<std::size_t>(std::min_element(joints.begin(), joints.end(), earlier) - joints.begin());
}

double left_out_start(double end) { return std::min(kLongestStart, kShareOfStart * end); }

Judged judge(const Recording& r, const MotionCycle& cycle, double period, double start) {
  Judged judged;
  window(judged, r.simulated, cycle, period, start);
  // The estimated period must not decide whether a row at the start of the window belongs to it.
  measure_window(r, judged.periods > 0 ? kWholePeriod * cycle.period : 0, judged);
  return judged;
}

Judged judge_from(const Recording& r, double from) {
  Judged judged;
  judged.from = from;
  judged.to = r.simulated;
  measure_window(r, 0, judged);
  return judged;
}

}  // namespace gaitlab
