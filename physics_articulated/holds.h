// Stuck hinges of the rollouts of a kernel, whose hold grows within a step.
#pragma once
#include <vector>

#include "core/laws/hinge_stop.h"
#include "core/plugin/fields.h"
#include "physics_articulated/motors.h"

namespace gaitlab::articulated {

/// Torque of a hinge at the end of a step, and its slope -d(torque)/d(speed).
template <class T>
struct StopTorque {
  T torque, slope;
};

template <class T>
class Holds {
 public:
  explicit Holds(std::size_t joints)
      : held_(joints, math::Mask<T>{}), angle_(joints, T(0.0)), since_(joints, T(0.0)), grip_(joints, T(0.0)) {}

  /// True if a hinge is stuck in a lane.
  [[nodiscard]] bool any() const { return any_; }

  /// See Plant::change_joints.
  void change(In hold, In since, const LaneRange& lanes) {
    any_ = false;
    for (std::size_t j = 0; j < held_.size(); ++j) {
      T held = 0.0;
      for (std::size_t l = 0; l < math::kLanes<T>; ++l) {
        const std::size_t i = j * lanes.all + lanes.first + l;
        const bool stuck = hold[i] == hold[i];  // false for NaN
        any_ = any_ || stuck;
        math::lane(held, l) = stuck ? 1 : 0;
        math::lane(angle_[j], l) = stuck ? hold[i] : 0;
        math::lane(since_[j], l) = stuck ? since[i] : 0;
      }
      held_[j] = held > T(0.0);
    }
    at(0);
  }

  /// Sets the grip to its value `within` seconds after the start of the whole step.
  void at(double within) {
    for (std::size_t j = 0; any_ && j < grip_.size(); ++j) grip_[j] = Hold::grip(since_[j] + T(within));
  }

  /// The torque of the hold after a part h of the step that ends with the speed qd. It is `stop` in lanes whose hinge is not
  /// stuck. If h = 0, it is the torque at the state (q, qd).
  [[nodiscard]] StopTorque<T> instead_of(const StopTorque<T>& stop, std::size_t j, const T& q, const T& qd, double h) const {
    using math::select;
    return {select(held_[j], Hold::torque(q + h * qd, qd, angle_[j], grip_[j]), stop.torque),
            select(held_[j], grip_[j] * T(Hold::kDamping + h * Hold::kStiffness), stop.slope)};
  }

 private:
  using Hold = BasicHingeHold<T>;

  bool any_ = false;
  std::vector<math::Mask<T>> held_;  ///< lanes with a stuck hinge, by joint
  std::vector<T> angle_, since_;     ///< rad; s, time stuck at the start of the step
  std::vector<T> grip_;
};

}  // namespace gaitlab::articulated
