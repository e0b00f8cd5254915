// Motors of a step for a scalar type T: their law at any speed, and the tangent of the law for a solve.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/laws/dc_motor.h"
#include "core/laws/joint_friction.h"
#include "core/laws/passive_hinge.h"
#include "core/plugin/actuator.h"

namespace gaitlab::articulated {

/// Lanes of the actuator that a kernel evaluates: kLanes of its `all` lanes, from `first` on.
struct LaneRange {
  std::size_t first = 0, all = 0;
};

/// Reflected inertia of each joint, kg m^2.
template <class T>
std::vector<T> reflected_inertia(std::size_t joints, const Actuator* actuator, const LaneRange& lanes) {
  std::vector<T> all(joints, T(0.0));
  const In inertia = actuator == nullptr ? In() : actuator->reflected_inertia();
  for (std::size_t j = 0; j < joints && !inertia.empty(); ++j) {
    for (std::size_t l = 0; l < math::kLanes<T>; ++l) math::lane(all[j], l) = inertia[j * lanes.all + lanes.first + l];
  }
  return all;
}

/// Evaluates motors with the friction of their joints. DC motors (Actuator::dc_motors) are evaluated here for all lanes at
/// once, other motors by their plugin. Commands have the index joint * lanes + lane. Torques are in N m, slopes -dT/dw in N m
/// s/rad.
///
/// The torque of a joint with dry friction jumps at rest, from `above` to `below` as its speed rises. In a step such a joint
/// has a mode: it turns forward (side 1) or backward (side -1), by the law of that side, which is continued past rest, or it
/// sticks, under any torque from `below` to `above`.
template <class T>
class StepMotors {
 public:
  /// `passive` lists the joints without a motor, which are treated as DC motors without voltage and torque, and `hinges` their
  /// laws, whose dry friction is set-valued like that of a motor. Motors other than DC motors require a kernel with all lanes
  /// of the actuator.
  StepMotors(const Actuator* actuator, std::size_t joints, std::span<const std::size_t> passive,
             std::span<const BasicPassiveHinge<T>> hinges, const LaneRange& lanes)
      : law(joints),
        law_slope(joints),
        torque(joints),
        slope(joints),
        scale(joints, T(1.0)),
        per_speed(joints, T(1.0 / kSpeed)),
        below(joints, T(0.0)),
        above(joints, T(0.0)),
        side(joints, T(1.0)),
        sticks(joints),
        jumps(joints),
        rest_(joints, T(0.0)),
        least_slope_(joints, T(0.0)),
        actuator_(actuator),
        passive_(passive.begin(), passive.end()) {
    if (actuator != nullptr) {
      find_scale(lanes);
      for (const std::size_t j : passive) least_slope_[j] = T(0.0);
      take_friction(lanes);
      if (actuator->dc_motors() != nullptr) dc_.resize(joints);
    }
    take_friction(hinges);
    take(passive, lanes);
  }

  /// Takes the constants of DC motors from the actuator.
  void take(std::span<const std::size_t> passive, const LaneRange& lanes) {
    if (dc_.empty()) return find_jumps();
    const DcMotor* from = actuator_->dc_motors() + lanes.first;
    constexpr auto kTo = BasicDcMotor<T>::constants();
    constexpr auto kFrom = DcMotor::constants();
    for (BasicDcMotor<T>& to : dc_) {
      for (std::size_t l = 0; l < math::kLanes<T>; ++l, ++from) {
        for (std::size_t k = 0; k < kTo.size(); ++k) math::lane(to.*kTo[k], l) = from->*kFrom[k];
      }
      from += lanes.all - math::kLanes<T>;
    }
    for (const std::size_t j : passive) dc_[j] = BasicDcMotor<T>();
    find_jumps();
  }

  [[nodiscard]] bool any() const { return actuator_ != nullptr; }
  [[nodiscard]] std::span<const std::size_t> passive() const { return passive_; }  ///< joints without a motor

  /// Takes the law of friction for explicit methods, without modes.
  void creep() {
    creeps_ = true;
    any_jump = false;
    for (const std::size_t j : passive_) {
      if (!friction_.empty()) friction_[j] = {};
    }
  }

  /// Sets the modes at the start of a step: a joint at rest sticks, another one goes on in its direction.
  void begin(In command, std::span<const T> speed) {
    if (!any_jump) return;
    const T zero = 0.0;
    const T one = 1.0;
    std::ranges::fill(side, -one);
    linearise(command, rest_);
    above = law;
    std::ranges::fill(side, one);
    linearise(command, rest_);
    below = law;
    for (std::size_t j = 0; j < side.size(); ++j) {
      side[j] = math::select(speed[j] < zero, -one, one);
      sticks[j] = math::mask_and(jumps[j], math::abs(speed[j]) <= zero);
    }
  }

  /// Computes law and law_slope at the speeds `speed`.
  void linearise(In command, std::span<const T> speed) {
    if (actuator_ == nullptr) {
      for (std::vector<T>* const values : {&law, &law_slope}) std::ranges::fill(*values, T(0.0));
    }
    if (actuator_ != nullptr && dc_.empty()) actuator_->effort(command, math::numbers(speed), numbers(law), numbers(law_slope));
    for (std::size_t j = 0; j < dc_.size(); ++j) {
      const auto effort = dc_[j].on(side[j], of_joint(command, j), speed[j]);
      law[j] = effort.torque;
      law_slope[j] = effort.slope;
    }
    for (std::size_t j = 0; j < friction_.size(); ++j) {
      const Friction& own = friction_[j];
      if (creeps_) {
        const auto effort = CreepingFriction<T>::at(own.dry, own.viscous, speed[j]);
        law[j] = law[j] + effort.torque;
        law_slope[j] = law_slope[j] + effort.slope;
      } else {
        law[j] = law[j] + own.torque(side[j], speed[j]);
        law_slope[j] = law_slope[j] + own.viscous;
      }
    }
  }

  /// Torque of friction of a joint that turns, or rests in a lane where it cannot stick, N m.
  [[nodiscard]] T friction(std::size_t j, const T& speed) const {
    if (friction_.empty()) return T(0.0);
    const T zero = 0.0, one = 1.0;
    return friction_[j].torque(math::select(speed < zero, -one, math::select(speed > zero, one, zero)), speed);
  }
  /// True if a joint has friction or its torque jumps.
  [[nodiscard]] bool rubs() const { return any_jump || !friction_.empty(); }

  /// Sets the tangent at the speed `end`, in the lanes `which`, for a solve that starts from the speed `start`. linearise()
  /// must have been called for `end`. A slope below 0, which no actuator should have, counts as 0. The solve then still has a
  /// solution, and the deviation from the law at its end is counted.
  void touch(std::size_t j, const math::Mask<T>& which, const T& start, const T& end) {
    const T falls = math::select(law_slope[j] > T(0.0), law_slope[j], T(0.0));
    slope[j] = math::select(which, falls, slope[j]);
    torque[j] = math::select(which, law[j] + falls * (end - start), torque[j]);
  }

  /// Lanes in which the motor was at its limit in the last solve and did not damp the speed: the slope of its tangent is below
  /// a tenth of the slope at rest. False for a passive joint and for an actuator without a slope.
  [[nodiscard]] math::Mask<T> at_limit(std::size_t j) const { return slope[j] < least_slope_[j]; }

  /// Computes Actuator::electrical of DC motors. Returns false if the motors are not DC motors.
  bool evaluate(In command, In speed, const Actuator::Electrical& out) const {
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

  /// Computes the largest torque of DC motors at the speeds `speed` in the direction of `torque_now`, N m. The result is
  /// infinity for motors without a largest voltage. Returns false if the motors are not DC motors.
  bool available(In speed, In torque_now, Out most) const {
    const T infinity = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < dc_.size(); ++j) {
      const auto backward = of_joint(torque_now, j) < T(0.0);
      const auto limited = dc_[j].u_max < infinity;
      const T largest = math::select(limited, dc_[j].u_max, T(0.0));
      const T w = of_joint(speed, j);
      const T held = math::select(backward, T(1.0), T(-1.0));  // at rest, the loss of the gear helps to hold
      const T turning = math::select(w < T(0.0), T(-1.0), math::select(w > T(0.0), T(1.0), held));
      const T there = dc_[j].on(turning, math::select(backward, -largest, largest), w).torque;
      store(math::select(limited, math::select(backward, -there, there), infinity), j, most);
    }
    return !dc_.empty();
  }

  std::vector<T> law, law_slope;             ///< results of linearise()
  std::vector<T> torque, slope;              ///< linear torque model of a solve: torque - slope (w - w_start)
  std::vector<T> scale;                      ///< largest torque at rest; 1 without a limit
  std::vector<T> per_speed;                  ///< torque per speed error: the slope at rest; scale / kSpeed if the slope is 0
  std::vector<T> below, above;               ///< least and largest torque of a joint that sticks, under the command of begin()
  std::vector<T> side;                       ///< mode of a joint that does not stick: 1 forward, -1 backward
  std::vector<math::Mask<T>> sticks, jumps;  ///< lanes in which the joint sticks, and in which its torque jumps at rest
  bool any_jump = false;

 private:
  struct Friction {
    T dry = 0.0, viscous = 0.0;
    [[nodiscard]] T torque(const T& side, const T& speed) const { return -(dry * side + viscous * speed); }
  };
  static constexpr double kLeastJump = 1e-6;  ///< share of the torque at rest; smaller dry friction is left out, because every
                                              ///< joint that trembles would stick and leave
  static constexpr double kSpeed = 3;         ///< rad/s; typical speed of the motors of modules
  static constexpr double kSlope =
      0.1;  ///< share of the slope at rest; a directional gear changes the slope by less, a limit by all of it

  void find_scale(const LaneRange& lanes) {
    const In limit = actuator_->command_limit();
    std::vector<double> rest(limit.size()), torques(limit.size()), slopes(limit.size());
    actuator_->effort(limit, rest, torques, slopes);
    const auto each = [&](const auto& set) {
      for (std::size_t i = 0; i < scale.size() * math::kLanes<T>; ++i) {
        set(i, i / math::kLanes<T> * lanes.all + lanes.first + i % math::kLanes<T>);
      }
    };
    const Out to = numbers(scale);
    each([&](std::size_t i, std::size_t from) {
      if (std::isfinite(torques[from]) && torques[from] > 0) to[i] = torques[from];
    });
    actuator_->effort(rest, rest, torques, slopes);
    each([&](std::size_t i, std::size_t from) {
      numbers(per_speed)[i] = slopes[from] > 0 ? slopes[from] : to[i] / kSpeed;
      numbers(least_slope_)[i] = slopes[from] > 0 ? kSlope * slopes[from] : 0;
    });
  }

  /// Takes the friction of the joints from the actuator, after find_scale().
  void take_friction(const LaneRange& lanes) {
    const std::span<const JointFriction> all = actuator_->friction();
    if (all.empty()) return;
    friction_.resize(law.size());
    for (std::size_t j = 0; j < friction_.size(); ++j) {
      for (std::size_t l = 0; l < math::kLanes<T>; ++l) {
        const JointFriction& from = all[j * lanes.all + lanes.first + l];
        math::lane(friction_[j].viscous, l) = from.viscous;
        if (from.dry > kLeastJump * math::lane(scale[j], l)) math::lane(friction_[j].dry, l) = from.dry;
      }
      per_speed[j] = per_speed[j] + friction_[j].viscous;
      least_slope_[j] = math::select(least_slope_[j] > T(0.0), least_slope_[j] + friction_[j].viscous, least_slope_[j]);
    }
  }

  /// Takes the dry friction of passive hinges.
  void take_friction(std::span<const BasicPassiveHinge<T>> hinges) {
    const auto rubs = [](const BasicPassiveHinge<T>& hinge) { return math::any_lane(hinge.friction > T(0.0)); };
    if (std::ranges::none_of(hinges, rubs)) return;
    friction_.resize(law.size());
    for (std::size_t k = 0; k < hinges.size(); ++k) friction_[passive_[k]] = {hinges[k].friction, T(0.0)};
  }

  void find_jumps() {
    any_jump = false;
    for (std::size_t j = 0; j < jumps.size() && !creeps_; ++j) {
      const T zero = 0.0;
      jumps[j] = {};
      if (!friction_.empty()) jumps[j] = friction_[j].dry > zero;
      if (!dc_.empty()) jumps[j] = math::mask_or(jumps[j], math::mask_and(dc_[j].jumps > zero, dc_[j].Kt > zero));
      any_jump = any_jump || math::any_lane(jumps[j]);
    }
  }

  static Out numbers(std::span<T> values) { return math::numbers(values); }
  static T of_joint(In command, std::size_t j) {
    T one;
    std::copy_n(command.data() + j * math::kLanes<T>, math::kLanes<T>, math::numbers(std::span<T>(&one, 1)).begin());
    return one;
  }
  static void store(const T& value, std::size_t j, Out to) {
    std::copy_n(math::numbers(std::span<const T>(&value, 1)).begin(), math::kLanes<T>, to.data() + j * math::kLanes<T>);
  }

  std::vector<T> rest_;         // speeds 0
  std::vector<T> least_slope_;  // least slope of a motor that is not at its limit; 0 for a motor without a slope
  const Actuator* actuator_;
  std::vector<std::size_t> passive_;
  std::vector<BasicDcMotor<T>> dc_;  // empty if the actuator plugin is called
  std::vector<Friction> friction_;   // empty without friction
  bool creeps_ = false;
};

}  // namespace gaitlab::articulated
