// The stop of a hinge outside its range: a spring and damper that only ever opposes, with its slopes.
#pragma once

namespace gaitlab {

/// torque = -ks (q - q_lim) - cs qd outside [lo, hi], cut off where it would pull back into the stop.  (chosen:
/// docs/equations.md, 2) q rad, qd rad/s, torque N m on the joint.
struct HingeStop {
  static constexpr double kStiffness = 50;  ///< ks, N m/rad
  static constexpr double kDamping = 0.5;   ///< cs, N m s/rad

  double torque = 0;
  double damping = 0;    ///< -d(torque)/d(qd), N m s/rad
  double stiffness = 0;  ///< -d(torque)/d(q), N m/rad

  static HingeStop at(double q, double qd, double lo, double hi) {
    const double excess = q > hi ? q - hi : q < lo ? q - lo : 0;
    if (excess == 0) return {};
    const double torque = -kStiffness * excess - kDamping * qd;
    if (torque * excess >= 0) return {};
    return {torque, kDamping, kStiffness};
  }
};

}  // namespace gaitlab
