#include "core/simulation/meter.h"

#include <algorithm>
#include <cmath>

#include "core/recording/motor_limit.h"

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

Meter::Meter(std::span<const Scenario> lanes) : lanes_(lanes.size()), time_(lanes.size()) {
  for (std::size_t j = 0; j < lanes[0].robot->joints.size(); ++j) {
    for (const Scenario& lane : lanes) {
      lo_.push_back(lane.robot->joints.at(j).lo);
      hi_.push_back(lane.robot->joints.at(j).hi);
      driven_.push_back(lane.robot->joints.at(j).driven());
    }
  }
  for (auto& sums : sums_) sums.assign(lo_.size(), 0.0);
  for (auto* values : {&recent_peak_, &recent_error_, &recent_limit_, &recent_speed_, &recent_envelope_, &recent_voltage_,
                       &recent_current_, &weight_, &share_, &seen_})
    values->assign(lo_.size(), 0.0);
}

void Meter::add(double time, const StepEffort::Part& part, In setpoint, const Actuator::Electrical& report, In available,
                In measured) {
  const std::size_t n = lo_.size();
  const In angle = part.angle;
  const In speed = part.speed;
  const In torque = part.torque;
  bool some = false;  // whose motion the part is
  for (std::size_t l = 0; l < lanes_; ++l) {
    const double sum = part.instant ? 0 : measured[l] * part.sum[l];
    const double share = part.instant ? 0 : measured[l] * part.share[l];
    const double seen = part.instant ? measured[l] : share > 0 ? 1 : 0;
    some = some || seen > 0;
    time_[l] += sum;
    for (std::size_t i = l; i < n; i += lanes_) {
      weight_[i] = sum;
      share_[i] = share;
      seen_[i] = seen;
    }
  }
  const auto peak = [&](double F::*member, auto value) {
    double* const to = at(sums_, member);
    if (!some) return;
    for (std::size_t i = 0; i < n; ++i) to[i] = std::max(to[i], seen_[i] * value(i));
  };
  const auto sum = [&](double F::*member, auto value) {
    if (part.instant) return;
    double* const to = at(sums_, member);
    for (std::size_t i = 0; i < n; ++i) to[i] += weight_[i] * value(i);
  };
  const auto share = [&](double F::*member, auto value) {
    if (part.instant || !some) return;
    double* const to = at(sums_, member);
    for (std::size_t i = 0; i < n; ++i) to[i] += share_[i] * value(i);
  };
  const auto error = [&](std::size_t i) { return driven_[i] ? setpoint[i] - angle[i] : 0.0; };
  const auto excess = [&](std::size_t i) { return std::max(std::max(angle[i] - hi_[i], lo_[i] - angle[i]), 0.0); };
  const auto shaft = [&](std::size_t i) { return torque[i] * speed[i]; };
  const auto first = [&](double F::*member, double F::*of, auto value) {  // before the peak itself, which decides
    const double* const largest = at(sums_, of);
    double* const when = at(sums_, member);
    for (std::size_t i = 0; some && i < n; ++i) when[i] = seen_[i] * value(i) > kLarger * largest[i] ? time : when[i];
  };
  const auto magnitude = [&](std::size_t i) { return std::abs(torque[i]); };
  const auto apart = [&](std::size_t i) { return std::abs(error(i)); };
  first(&F::torque_peak_time, &F::torque_peak, magnitude);
  peak(&F::torque_peak, magnitude);
  for (std::size_t i = 0; some && i < n; ++i) {
    const double torque_now = seen_[i] * magnitude(i);
    recent_limit_[i] = torque_now > recent_peak_[i] ? report.saturation[i] : recent_limit_[i];
    recent_peak_[i] = std::max(recent_peak_[i], torque_now);
    recent_error_[i] = std::max(recent_error_[i], seen_[i] * apart(i));
    recent_speed_[i] = std::max(recent_speed_[i], seen_[i] * std::abs(speed[i]));
    const double used = torque_now < available[i] ? torque_now / available[i] : torque_now > 0 ? 1.0 : 0.0;
    recent_envelope_[i] = std::max(recent_envelope_[i], used);
    recent_voltage_[i] = std::max(recent_voltage_[i], seen_[i] * std::abs(report.voltage[i]));
    recent_current_[i] = std::max(recent_current_[i], seen_[i] * std::abs(report.current[i]));
  }
  share(&F::torque_rms, [&](std::size_t i) { return torque[i] * torque[i]; });
  peak(&F::speed_peak, [&](std::size_t i) { return std::abs(speed[i]); });
  peak(&F::current_peak, [&](std::size_t i) { return std::abs(report.current[i]); });
  share(&F::current_rms, [&](std::size_t i) { return report.current[i] * report.current[i]; });
  sum(&F::error_rms, [&](std::size_t i) { return error(i) * error(i); });
  first(&F::error_peak_time, &F::error_peak, apart);
  peak(&F::error_peak, apart);
  if (time == 0) peak(&F::start_jump, apart);
  const auto limited = [&](MotorLimit limit) {
    return [&report, at = saturation_of(limit)](std::size_t i) { return report.saturation[i] == at ? 1.0 : 0.0; };
  };
  share(&F::saturated_voltage, limited(MotorLimit::voltage));
  share(&F::saturated_current, limited(MotorLimit::current));
  share(&F::range_share, [&](std::size_t i) { return excess(i) > 0 ? 1.0 : 0.0; });
  peak(&F::range_worst, excess);
  share(&F::setpoint_outside,
        [&](std::size_t i) { return driven_[i] && (setpoint[i] > hi_[i] || setpoint[i] < lo_[i]) ? 1.0 : 0.0; });
  sum(&F::electrical, [&](std::size_t i) { return report.power_in[i]; });
  sum(&F::copper, [&](std::size_t i) { return report.copper[i]; });
  sum(&F::gear, [&](std::size_t i) { return report.gear[i]; });
  share(&F::created, [&](std::size_t i) { return std::max(-report.gear[i], 0.0); });
  sum(&F::shaft, shaft);
  share(&F::shaft_positive, [&](std::size_t i) { return std::max(shaft(i), 0.0); });
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
  for (std::size_t i = lane; i < lo_.size(); i += lanes_) {
    for (const double value : {recent_peak_[i], recent_error_[i], recent_limit_[i], square[i], voltage[i], current[i],
                               recent_speed_[i], recent_envelope_[i], amperes[i], recent_voltage_[i], recent_current_[i]})
      row[to++] = value;
    for (auto* recent :
         {&recent_peak_, &recent_error_, &recent_limit_, &recent_speed_, &recent_envelope_, &recent_voltage_, &recent_current_})
      (*recent)[i] = 0;
  }
}

}  // namespace gaitlab
