// Friction of driven joints: dry and viscous.
#pragma once
#include <cmath>

#include "core/math/functions.h"
#include "core/math/lanes.h"
#include "core/plugin/actuator.h"

namespace gaitlab {

/// Friction law for explicit methods:
///     T = -dry tanh(w / kCreep) - viscous w        (docs/equations.md, 3)
/// w: joint speed, rad/s; T: torque on the joint, N m. A law that jumps at w = 0 would make such a method chatter. A joint that
/// should stick creeps instead, at less than kCreep. Methods that are implicit in the motors have the exact law
/// (JointFriction). T: double or lanes.
template <class T>
struct CreepingFriction {
  static constexpr double kCreep = 0.1;  ///< rad/s; chosen, the default of a passive hinge

  T torque, slope;  ///< N m; -dT/dw, N m s/rad

  static CreepingFriction at(const T& dry, const T& viscous, const T& speed) {
    using math::tanh;
    const T t = tanh(T(1 / kCreep) * speed);
    return {-(dry * t + viscous * speed), T(1 / kCreep) * dry * (T(1.0) - t * t) + viscous};
  }
};

/// Adds the friction law for explicit methods to torques and slopes with the index joint * lanes + lane.
inline void add_creeping(std::span<const JointFriction> friction, In speed, Out torque, Out slope) {
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const auto here = CreepingFriction<double>::at(friction[i].dry, friction[i].viscous, speed[i]);
    torque[i] += here.torque;
    slope[i] += here.slope;
  }
}

/// Friction torque in the direction `along` (1 or -1), N m; at rest the largest one, with which friction helps to hold.
inline double friction_along(const JointFriction& friction, double speed, double along) {
  const double turns = along * speed;
  return (turns > 0 ? -friction.dry : friction.dry) - friction.viscous * turns;
}

/// Power lost in friction of a joint, W, by the law for explicit methods if `creeps`.
inline double power_lost(const JointFriction& friction, double speed, bool creeps) {
  if (creeps) return -CreepingFriction<double>::at(friction.dry, friction.viscous, speed).torque * speed;
  return friction.dry * std::abs(speed) + friction.viscous * speed * speed;
}

}  // namespace gaitlab
