#include "core/simulation/meter.h"

#include <algorithm>
#include <cmath>

namespace gaitlab {

Meter::Meter(const Robot& robot, std::size_t lanes) : sums_(robot.joints.size() * lanes), lanes_(lanes) {
  for (const Joint& joint : robot.joints) {
    lo_.insert(lo_.end(), lanes, joint.lo);
    hi_.insert(hi_.end(), lanes, joint.hi);
  }
}

void Meter::add(In angle, In speed, In setpoint, In torque, const Actuator::Report& report, double h) {
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    JointFigures& s = sums_[i];
    const double error = setpoint[i] - angle[i];
    const double excess = std::max({angle[i] - hi_[i], lo_[i] - angle[i], 0.0});
    const double shaft = torque[i] * speed[i];
    s.torque_peak = std::max(s.torque_peak, std::abs(torque[i]));
    s.torque_rms += h * torque[i] * torque[i];
    s.speed_peak = std::max(s.speed_peak, std::abs(speed[i]));
    s.current_peak = std::max(s.current_peak, std::abs(report.current[i]));
    s.current_rms += h * report.current[i] * report.current[i];
    s.error_rms += h * error * error;
    s.error_peak = std::max(s.error_peak, std::abs(error));
    s.saturated_voltage += report.saturation[i] == 1 ? h : 0;
    s.saturated_current += report.saturation[i] == 2 ? h : 0;
    s.range_share += excess > 0 ? h : 0;
    s.range_worst = std::max(s.range_worst, excess);
    s.setpoint_outside += setpoint[i] > hi_[i] || setpoint[i] < lo_[i] ? h : 0;
    s.electrical += h * report.power_in[i];
    s.copper += h * report.copper[i];
    s.gear += h * report.gear[i];
    s.created += h * std::max(-report.gear[i], 0.0);
    s.shaft += h * shaft;
    s.shaft_positive += h * std::max(shaft, 0.0);
  }
  time_ += h;
}

JointFigures Meter::figures(std::size_t joint, std::size_t lane) const {
  JointFigures f = sums_[joint * lanes_ + lane];
  if (!(time_ > 0)) return f;
  for (double* mean_square : {&f.torque_rms, &f.current_rms, &f.error_rms}) *mean_square = std::sqrt(*mean_square / time_);
  for (double* share : {&f.saturated_voltage, &f.saturated_current, &f.range_share, &f.setpoint_outside}) *share /= time_;
  return f;
}

}  // namespace gaitlab
