// Torque law of a hinge without a motor: spring, damper and dry friction, with their slopes.
#pragma once
#include "core/math/functions.h"
#include "core/math/lanes.h"
#include "core/model/passive.h"

namespace gaitlab {

/// torque = -K (q - rest) - D w - F tanh(w / w_s)  (chosen: docs/equations.md, 2)
/// q: angle, rad; w: speed, rad/s; torque on the joint, N m. For explicit methods: friction is viscous below w_s, so that it
/// has a slope, and a torque below F makes the hinge creep. Implicit methods take spring and damper from here, with F = 0, and
/// dry friction as that of a driven joint (JointFriction), so that the hinge sticks. T: double or lanes.
template <class T>
struct BasicPassiveHinge {
  T stiffness = 0.0, rest = 0.0, damping = 0.0, friction = 0.0, friction_speed = 1.0;

  /// Torque of damper and friction, N m, and its slope -d(torque)/dw, N m s/rad.
  struct Loss {
    T torque, slope;
  };
  [[nodiscard]] Loss loss(const T& w) const {
    using math::tanh;
    const T t = tanh(w / friction_speed);
    return {-(damping * w + friction * t), damping + friction / friction_speed * (T(1.0) - t * t)};
  }
  [[nodiscard]] T spring(const T& q) const { return -(stiffness * (q - rest)); }                     ///< N m
  [[nodiscard]] T energy(const T& q) const { return T(0.5) * stiffness * (q - rest) * (q - rest); }  ///< spring, J
};

using PassiveHinge = BasicPassiveHinge<double>;

inline PassiveHinge law(const Passive& p) { return {p.stiffness, p.rest, p.damping, p.friction, p.friction_speed}; }

}  // namespace gaitlab
