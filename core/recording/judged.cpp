#include "core/recording/judged.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace gaitlab {

namespace {

constexpr double kLongestStart = 2;    // s, without a limit cycle
constexpr double kShareOfStart = 0.2;  // of the run, without a limit cycle
constexpr double kWholePeriod = 1e-3;  // of a period: what it may miss and be whole
constexpr double kSameTime = 1e-9;     // s

void window(Judged& judged, double end, const MotionCycle& cycle) {
  judged.to = end;
  judged.from = cycle.found ? std::min(cycle.from, cycle.period) : std::min(kLongestStart, kShareOfStart * end);
  if (!cycle.found) return;
  judged.periods = static_cast<std::size_t>((end - judged.from) / cycle.period + kWholePeriod);
  judged.from = std::max(0.0, end - static_cast<double>(judged.periods) * cycle.period);
}

/// The last row at `time` or before.
std::size_t row_at(const Series& t, double time) {
  std::size_t row = 0;
  while (row + 1 < t.size() && t[row + 1] <= time + kSameTime) ++row;
  return row;
}

struct Peak {
  double& value;
  double& time;
  bool offer(double now, double t) const {
    if (!(std::abs(now) > value)) return false;
    value = std::abs(now);
    time = t;
    return true;
  }
};

JudgedJoint from_ticks(const Trace& ticks, std::size_t joint, std::size_t first) {
  const auto column = [&](std::size_t which) { return Series(ticks, 1 + joint * kTickColumns + which); };
  const Series t(ticks, 0);
  const Series torque = column(0);
  const Series error = column(1);
  const Series square = column(2);
  const Series voltage = column(3);
  const Series current = column(4);
  JudgedJoint j;
  for (std::size_t k = first + 1; k < t.size(); ++k) {
    if (Peak{j.torque_peak, j.torque_peak_time}.offer(torque[k], t[k])) {
      j.peak_at_limit = voltage[k] + current[k] > voltage[k - 1] + current[k - 1];
    }
    Peak{j.error_peak, j.error_peak_time}.offer(error[k], t[k]);
  }
  const double span = t.back() - t[first];
  if (!(span > 0)) return j;
  j.torque_rms = std::sqrt(std::max(0.0, square.back() - square[first]) / span);
  j.voltage_limited = (voltage.back() - voltage[first]) / span;
  j.current_limited = (current.back() - current[first]) / span;
  return j;
}

}  // namespace

std::size_t Judged::limited() const {
  return static_cast<std::size_t>(
      std::count_if(joints.begin(), joints.end(), [](const JudgedJoint& joint) { return joint.limited() > 0; }));
}

std::size_t Judged::farthest() const {
  const auto nearer = [](const JudgedJoint& a, const JudgedJoint& b) { return a.error_peak < b.error_peak; };
  return static_cast<std::size_t>(std::max_element(joints.begin(), joints.end(), nearer) - joints.begin());
}

Judged judge(const Recording& r, const MotionCycle& cycle) {
  Judged judged;
  window(judged, r.simulated, cycle);
  judged.joints.resize(r.joints.size());
  const bool known = r.ticks.rows() > 0 && r.ticks.columns.size() == 1 + kTickColumns * r.joints.size();
  const std::size_t first = known ? row_at(Series(r.ticks, 0), judged.from) : 0;
  for (std::size_t j = 0; known && j < r.joints.size(); ++j) judged.joints[j] = from_ticks(r.ticks, j, first);
  judged.order.resize(judged.joints.size());
  std::iota(judged.order.begin(), judged.order.end(), 0);
  std::stable_sort(judged.order.begin(), judged.order.end(), [&](std::size_t a, std::size_t b) {
    const JudgedJoint& one = judged.joints[a];
    const JudgedJoint& other = judged.joints[b];
    return std::tuple(one.limited(), one.torque_rms, one.torque_peak) >
           std::tuple(other.limited(), other.torque_rms, other.torque_peak);
  });
  return judged;
}

}  // namespace gaitlab
