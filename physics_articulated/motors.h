// The motors of a step, over a scalar T: what they give at its start, and which of them their limit holds at its end.
#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/laws/dc_motor.h"
#include "core/plugin/actuator.h"

namespace gaitlab::articulated {

/// A step of h sees torque - h slope v'. DC motors (Actuator::dc_motors) are evaluated here, lanes at once; others through
/// their plugin. Commands: joint * lanes + lane.
template <class T>
class Motors {
 public:
  Motors(const Actuator* actuator, std::size_t joints)
      : torque(joints), slope(joints), actuator_(actuator), held_(joints), some_(joints), all_(joints) {
    for (auto* values : {&start_torque_, &start_slope_, &limited_, &limited_slope_, &unlimited_, &unlimited_slope_})
      values->resize(joints);
    if (actuator == nullptr) return;
    const DcMotor* from = actuator->dc_motors();
    if (from == nullptr) return;
    dc_.resize(joints);
    for (BasicDcMotor<T>& to : dc_) {
      for (std::size_t l = 0; l < math::kLanes<T>; ++l, ++from) {
        const std::array values{from->R,     from->Kt,    from->Ks,   from->gear, from->efficiency,
                                from->u_max, from->i_max, from->turn, from->steep};
        const std::array places{&to.R, &to.Kt, &to.Ks, &to.gear, &to.efficiency, &to.u_max, &to.i_max, &to.turn, &to.steep};
        for (std::size_t k = 0; k < values.size(); ++k) math::lane(*places[k], l) = values[k];
      }
    }
  }

  /// At the step's start, whatever current that takes.
  void start(In command, std::span<const T> speed) {
    for (std::size_t j = 0; j < dc_.size(); ++j) {
      const auto effort = dc_[j].unlimited(of_joint(command, j), speed[j]);
      start_torque_[j] = effort.torque;
      start_slope_[j] = effort.slope;
    }
    if (actuator_ != nullptr && dc_.empty()) {
      actuator_->unlimited(command, math::numbers(speed), numbers(start_torque_), numbers(start_slope_));
    }
  }
  /// After start: joints whose limit binds there, and then, by remember after each solve, those that were held: has_corner
  /// tells of the joints for which it is not all the same.
  void watch(In command, std::span<const T> speed) {
    if (actuator_ != nullptr && dc_.empty()) {
      actuator_->effort(command, math::numbers(speed), numbers(limited_), numbers(limited_slope_));
    }
    for (std::size_t j = 0; j < held_.size(); ++j) {
      if (actuator_ == nullptr) break;
      unlimited_[j] = start_torque_[j];
      const Limit limit = dc_.empty() ? asked(j) : evaluated(j, of_joint(command, j), speed[j]);
      some_[j].yes = all_[j].yes = limit.passed;
    }
  }
  void remember() {
    for (std::size_t j = 0; j < held_.size(); ++j) {
      some_[j].yes = math::either(some_[j].yes, held_[j].yes);
      all_[j].yes = math::both(all_[j].yes, held_[j].yes);
    }
  }
  [[nodiscard]] math::Mask<T> has_corner(std::size_t j) const { return math::fresh(some_[j].yes, all_[j].yes); }

  /// What start found, none held.
  void begin() {
    torque = start_torque_;
    slope = start_slope_;
    std::fill(held_.begin(), held_.end(), Held{});
  }

  /// Holds motors at the limits that the step's end passes, there being any that were not held; torque and slope are then the
  /// law's at that end.
  bool hold(In command, std::span<const T> speed, std::span<const T> end) {
    if (actuator_ == nullptr) return false;
    if (dc_.empty()) {
      actuator_->effort(command, math::numbers(end), numbers(limited_), numbers(limited_slope_));
      actuator_->unlimited(command, math::numbers(end), numbers(unlimited_), numbers(unlimited_slope_));
    }
    bool more = false;
    for (std::size_t j = 0; j < torque.size(); ++j) {
      const Limit limit = dc_.empty() ? asked(j) : evaluated(j, of_joint(command, j), end[j]);
      const auto now = math::fresh(limit.passed, held_[j].yes);
      if (!math::any(now)) continue;
      more = true;
      held_[j].yes = math::either(held_[j].yes, now);
      slope[j] = math::select(now, limit.slope, slope[j]);
      torque[j] = math::select(now, limit.torque + limit.slope * (end[j] - speed[j]), torque[j]);
    }
    return more;
  }
  /// The law itself, for an explicit method.
  void evaluate(In command, std::span<const T> speed) {
    if (actuator_ != nullptr) actuator_->effort(command, math::numbers(speed), numbers(torque), numbers(slope));
  }

  /// Actuator::report of DC motors; false: they are none.
  bool report(In command, In speed, const Actuator::Report& out) const {
    for (std::size_t j = 0; j < dc_.size(); ++j) {
      const auto e = dc_[j](of_joint(command, j), of_joint(speed, j));
      store(e.voltage, j, out.voltage);
      store(e.current, j, out.current);
      store(e.saturation(), j, out.saturation);
      store(e.drawn, j, out.power_in);
      store(e.copper, j, out.copper);
      store(e.gear, j, out.gear);
    }
    return !dc_.empty();
  }

  std::vector<T> torque, slope;  ///< as the solve takes them, N m, N m s/rad

 private:
  struct Held {
    math::Mask<T> yes{};
  };
  struct Limit {
    T torque, slope;
    math::Mask<T> passed;
  };

  static Out numbers(std::span<T> values) { return math::numbers(values); }
  static T of_joint(In command, std::size_t j) {
    T one;
    std::copy_n(command.data() + j * math::kLanes<T>, math::kLanes<T>, math::numbers(std::span<T>(&one, 1)).begin());
    return one;
  }
  static void store(const T& value, std::size_t j, Out to) {
    std::copy_n(math::numbers(std::span<const T>(&value, 1)).begin(), math::kLanes<T>, to.data() + j * math::kLanes<T>);
  }
  /// By the plugin, which hold has asked.
  Limit asked(std::size_t j) const {
    const auto above = limited_[j] > unlimited_[j];
    const auto below = unlimited_[j] > limited_[j];
    return {limited_[j], limited_slope_[j], math::either(above, below)};
  }
  Limit evaluated(std::size_t j, const T& command, const T& speed) const {
    const auto effort = dc_[j](command, speed);
    return {effort.torque, effort.slope, effort.limited};
  }

  const Actuator* actuator_;
  std::vector<BasicDcMotor<T>> dc_;                                       // empty: asks the actuator
  std::vector<T> start_torque_, start_slope_;                             // at the step's start
  std::vector<T> limited_, limited_slope_, unlimited_, unlimited_slope_;  // asked at its end
  std::vector<Held> held_, some_, all_;
};

}  // namespace gaitlab::articulated
