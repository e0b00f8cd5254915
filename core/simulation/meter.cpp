#include "core/simulation/meter.h"

#include <algorithm>
#include <cmath>

namespace gaitlab {

namespace {

using F = JointStatistics;

template <class Sums>
double* at(Sums& sums, double F::*member) {
  const auto place = std::find_if(kJointStatistics.begin(), kJointStatistics.end(),
                                  [&](const JointStatistic& one) { return one.member == member; });
  return sums[static_cast<std::size_t>(place - kJointStatistics.begin())].data();
}

}  // namespace

Meter::Meter(std::span<const Scenario> lanes)
    : lanes_(lanes.size()),
      entries_(lanes.size() * lanes[0].robot->joints.size()),
      pass_(__builtin_cpu_supports("avx2") != 0 ? add_pass_avx2 : add_pass),
      last_command_(entries_),
      current_peak_(lanes.size()),
      current_square_(lanes.size()),
      time_(lanes.size()) {
  for (std::size_t j = 0; j < lanes[0].robot->joints.size(); ++j) {
    for (const Scenario& lane : lanes) {
      lo_.push_back(lane.robot->joints.at(j).lo);
      hi_.push_back(lane.robot->joints.at(j).hi);
      driven_.push_back(lane.robot->joints.at(j).driven() ? 1 : 0);
    }
  }
  const std::size_t blocks = (entries_ + kMeterBlock - 1) / kMeterBlock;
  for (auto* values : {&lo_, &hi_, &driven_}) values->resize(blocks * kMeterBlock);
  for (auto& sums : sums_) sums.assign(lo_.size(), 0.0);
  for (auto* values : {&recent_peak_, &recent_error_, &recent_limit_, &recent_speed_, &recent_envelope_, &recent_voltage_,
                       &recent_current_, &weight_, &share_, &seen_})
    values->assign(lo_.size(), 0.0);
}

void Meter::add(double time, const StepEffort::Part& part, In setpoint, const Actuator::Electrical& report, In dry,
                In available, In measured) {
  MeterPass pass{.time = time, .instant = part.instant};
  for (std::size_t l = 0; l < lanes_; ++l) {
    const double sum = part.instant ? 0 : measured[l] * part.sum[l];
    const double share = part.instant ? 0 : measured[l] * part.share[l];
    const double seen = part.instant ? measured[l] : share > 0 ? 1 : 0;
    pass.some = pass.some || seen > 0;
    time_[l] += sum;
    double current = 0;
    for (std::size_t i = l; i < entries_; i += lanes_) {
      current += std::abs(report.current[i]);
      weight_[i] = sum;
      share_[i] = share;
      seen_[i] = seen;
    }
    current_square_[l] += sum * current * current;
    if (seen > 0) current_peak_[l] = std::max(current_peak_[l], current);
  }
  const std::array<const double*, kInputs> inputs{part.angle.data(),
                                                  part.speed.data(),
                                                  part.torque.data(),
                                                  setpoint.data(),
                                                  report.voltage.data(),
                                                  report.current.data(),
                                                  report.saturation.data(),
                                                  report.power_in.data(),
                                                  report.copper.data(),
                                                  report.gear.data(),
                                                  dry.data(),
                                                  available.data()};
  const std::size_t whole = entries_ - entries_ % kMeterBlock;
  pass.entries = whole;
  add(pass, inputs, 0);
  if (whole == entries_) return;
  std::array<const double*, kInputs> rest{};
  for (std::size_t k = 0; k < kInputs; ++k) {
    std::copy(inputs[k] + whole, inputs[k] + entries_, rest_[k].begin());
    rest[k] = rest_[k].data();
  }
  pass.entries = kMeterBlock;
  add(pass, rest, whole);
}

/// Runs the pass over the entries that start at `from`. The input arrays start at the same entry.
void Meter::add(MeterPass pass, const std::array<const double*, kInputs>& inputs, std::size_t from) {
  const auto [angle, speed, torque, setpoint, voltage, current, saturation, power_in, copper, gear, dry, available] = inputs;
  pass.in = {angle, speed, torque, setpoint, voltage, current, saturation, power_in, copper, gear, dry, available};
  const auto at = [from](auto& values) { return values.data() + from; };
  pass.lo = at(lo_);
  pass.hi = at(hi_);
  pass.driven = at(driven_);
  pass.weight = at(weight_);
  pass.share = at(share_);
  pass.seen = at(seen_);
  for (std::size_t k = 0; k < sums_.size(); ++k) pass.sums[k] = at(sums_[k]);
  pass.recent = {at(recent_peak_),     at(recent_error_),   at(recent_limit_),  at(recent_speed_),
                 at(recent_envelope_), at(recent_voltage_), at(recent_current_)};
  pass_(pass);
}

// Largest sum over a stretch that ends now, with +1 for a change of sign and -1 for no change (Kadane's algorithm).
void Meter::command(double time, std::size_t lane, In command) {
  double* const reversals = at(sums_, &F::reversals);
  double* const from = at(sums_, &F::reversing_from);
  for (std::size_t i = lane, j = 0; i < entries_; i += lanes_, ++j) {
    const double now = command[j];
    const double last = last_command_[i];
    if (now == 0 || std::isnan(now)) continue;
    last_command_[i] = now;
    if (last == 0) continue;
    const bool reverses = (now > 0) != (last > 0);
    if (reversals[i] == 0) from[i] = time;
    reversals[i] = std::max(0.0, reversals[i] + (reverses ? 1 : -1));
  }
}

std::pair<double, double> Meter::current(std::size_t lane) const {
  return {current_peak_[lane], time_[lane] > 0 ? std::sqrt(current_square_[lane] / time_[lane]) : 0};
}

JointStatistics Meter::statistics(std::size_t joint, std::size_t lane) const {
  F f;
  for (std::size_t k = 0; k < sums_.size(); ++k) f.*kJointStatistics[k].member = sums_[k][joint * lanes_ + lane];
  const double time = time_[lane];
  if (!(time > 0)) return f;
  for (double* mean_square : {&f.torque_rms, &f.current_rms, &f.error_rms})
    *mean_square = std::sqrt(std::max(*mean_square, 0.0) / time);
  for (double* share : {&f.saturated_voltage, &f.saturated_current, &f.range_share, &f.setpoint_outside}) *share /= time;
  return f;
}

void Meter::tick(std::size_t lane, Out row) {
  const double* const square = at(sums_, &F::torque_rms);
  const double* const voltage = at(sums_, &F::saturated_voltage);
  const double* const current = at(sums_, &F::saturated_current);
  const double* const amperes = at(sums_, &F::current_rms);
  std::size_t to = 0;
  for (std::size_t i = lane; i < entries_; i += lanes_) {
    for (const double value : {recent_peak_[i], recent_error_[i], recent_limit_[i], square[i], voltage[i], current[i],
                               recent_speed_[i], recent_envelope_[i], amperes[i], recent_voltage_[i], recent_current_[i]})
      row[to++] = value;
    for (auto* recent :
         {&recent_peak_, &recent_error_, &recent_limit_, &recent_speed_, &recent_envelope_, &recent_voltage_, &recent_current_})
      (*recent)[i] = 0;
  }
}

}  // namespace gaitlab
