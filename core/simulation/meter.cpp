#include "core/simulation/meter.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gaitlab {

namespace {

/// Where a figure is in Meter::figures_.
template <class Figures>
double* at(Figures& figures, double JointFigures::*member) {
  constexpr JointFigures kAny{};
  return figures[static_cast<std::size_t>(&(kAny.*member) - &kAny.torque_peak)].data();
}

}  // namespace

Meter::Meter(std::span<const Scenario> lanes) : lanes_(lanes.size()), time_(lanes.size()), seen_(lanes.size()) {
  for (std::size_t j = 0; j < lanes[0].robot->joints.size(); ++j) {
    for (const Scenario& lane : lanes) {
      lo_.push_back(lane.robot->joints.at(j).lo);
      hi_.push_back(lane.robot->joints.at(j).hi);
    }
  }
  for (auto& figure : figures_) figure.assign(lo_.size(), 0.0);
}

void Meter::add(const Applied::Part& part, In setpoint, const Actuator::Report& report, std::size_t from, std::size_t to) {
  const std::size_t joints = lo_.size() / lanes_;
  const In angle = part.angle;
  const In speed = part.speed;
  const In torque = part.torque;
  for (std::size_t l = from; l < to; ++l) seen_[l] = part.instant || part.share[l] > 0 ? 1 : 0;
  const auto peak = [&](double JointFigures::*member, auto value) {
    double* const figure = at(figures_, member);
    for (std::size_t j = 0; j < joints; ++j) {
      for (std::size_t l = from, i = j * lanes_ + l; l < to; ++l, ++i) figure[i] = std::max(figure[i], seen_[l] * value(i));
    }
  };
  const auto weighted = [&](In weight, double JointFigures::*member, auto value) {
    if (part.instant) return;
    double* const figure = at(figures_, member);
    for (std::size_t j = 0; j < joints; ++j) {
      for (std::size_t l = from, i = j * lanes_ + l; l < to; ++l, ++i) figure[i] += weight[l] * value(i);
    }
  };
  const auto sum = [&](double JointFigures::*member, auto value) { weighted(part.sum, member, value); };
  const auto share = [&](double JointFigures::*member, auto value) { weighted(part.share, member, value); };
  const auto error = [&](std::size_t i) { return setpoint[i] - angle[i]; };
  const auto excess = [&](std::size_t i) { return std::max(std::max(angle[i] - hi_[i], lo_[i] - angle[i]), 0.0); };
  const auto shaft = [&](std::size_t i) { return torque[i] * speed[i]; };
  using F = JointFigures;
  peak(&F::torque_peak, [&](std::size_t i) { return std::abs(torque[i]); });
  sum(&F::torque_rms, [&](std::size_t i) { return torque[i] * torque[i]; });
  peak(&F::speed_peak, [&](std::size_t i) { return std::abs(speed[i]); });
  peak(&F::current_peak, [&](std::size_t i) { return std::abs(report.current[i]); });
  sum(&F::current_rms, [&](std::size_t i) { return report.current[i] * report.current[i]; });
  sum(&F::error_rms, [&](std::size_t i) { return error(i) * error(i); });
  peak(&F::error_peak, [&](std::size_t i) { return std::abs(error(i)); });
  share(&F::saturated_voltage, [&](std::size_t i) { return report.saturation[i] == 1 ? 1.0 : 0.0; });
  share(&F::saturated_current, [&](std::size_t i) { return report.saturation[i] == 2 ? 1.0 : 0.0; });
  share(&F::range_share, [&](std::size_t i) { return excess(i) > 0 ? 1.0 : 0.0; });
  peak(&F::range_worst, excess);
  share(&F::setpoint_outside, [&](std::size_t i) { return setpoint[i] > hi_[i] || setpoint[i] < lo_[i] ? 1.0 : 0.0; });
  sum(&F::electrical, [&](std::size_t i) { return report.power_in[i]; });
  sum(&F::copper, [&](std::size_t i) { return report.copper[i]; });
  sum(&F::gear, [&](std::size_t i) { return report.gear[i]; });
  sum(&F::created, [&](std::size_t i) { return std::max(-report.gear[i], 0.0); });
  sum(&F::shaft, shaft);
  sum(&F::shaft_positive, [&](std::size_t i) { return std::max(shaft(i), 0.0); });
  for (std::size_t l = from; l < to && !part.instant; ++l) time_[l] += part.sum[l];
}

JointFigures Meter::figures(std::size_t joint, std::size_t lane) const {
  std::array<double, kFigures> of_joint{};
  for (std::size_t k = 0; k < kFigures; ++k) of_joint[k] = figures_[k][joint * lanes_ + lane];
  auto f = std::bit_cast<JointFigures>(of_joint);
  const double time = time_[lane];
  if (!(time > 0)) return f;
  for (double* mean_square : {&f.torque_rms, &f.current_rms, &f.error_rms}) *mean_square = std::sqrt(std::max(*mean_square, 0.0) / time);
  for (double* share : {&f.saturated_voltage, &f.saturated_current, &f.range_share, &f.setpoint_outside}) *share /= time;
  return f;
}

}  // namespace gaitlab
