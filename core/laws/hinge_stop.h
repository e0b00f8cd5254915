// Stop of a hinge outside its range: a spring and damper that only pushes back, with its slopes.
#pragma once
#include "core/math/lanes.h"
#include "core/model/play.h"

namespace gaitlab {

/// torque = -ks (q - q_lim) - cs qd outside [lo, hi], and 0 if this torque would pull towards the stop.
/// (chosen: docs/equations.md, 2)
/// q: angle, rad; qd: speed, rad/s; torque on the joint, N m. T: double or lanes.
template <class T>
struct BasicHingeStop {
  static constexpr double kStiffness = kStopStiffness;  ///< ks, N m/rad
  static constexpr double kDamping = kStopDamping;      ///< cs, N m s/rad

  T torque = 0.0;
  T damping = 0.0;    ///< -d(torque)/d(qd), N m s/rad
  T stiffness = 0.0;  ///< -d(torque)/d(q), N m/rad

  /// The stiffness k and damping c of another stop may be given.
  static BasicHingeStop at(const T& q, const T& qd, const T& lo, const T& hi, const T& k = T(kStiffness),
                           const T& c = T(kDamping)) {
    using math::select;
    const T zero = 0.0;
    const T excess = select(q > hi, q - hi, select(q < lo, q - lo, zero));
    const T torque = -k * excess - c * qd;
    const math::Mask<T> rests = torque * excess >= 0.0;
    return {select(rests, zero, torque), select(rests, zero, c), select(rests, zero, k)};
  }
};

using HingeStop = BasicHingeStop<double>;

/// Hinge that is stuck at an angle: torque = grip (-kh (q - q_hold) - ch qd), in both directions, instead of the stop. (chosen:
/// a hundred times the constants of the stop, so that motors of 2 N m turn the hinge by less than 1e-3 rad; docs/real-robot.md)
/// The grip rises from 0 to 1 in kRamp. If ch acted immediately, a joint that jams in motion would stop within 20 us, by a
/// torque that depends on ch alone.
template <class T>
struct BasicHingeHold {
  static constexpr double kRamp = 0.02;                                      ///< s
  static constexpr double kStiffness = 100 * BasicHingeStop<T>::kStiffness;  ///< kh, N m/rad
  static constexpr double kDamping = 100 * BasicHingeStop<T>::kDamping;      ///< ch, N m s/rad

  /// `since`: time since the hinge got stuck, s.
  static T grip(const T& since) {
    const T share = since * (1 / kRamp);
    const T one = 1.0;
    return math::select(share < one, share, one);
  }
  static T torque(const T& q, const T& qd, const T& hold, const T& grip) {
    return grip * (-kStiffness * (q - hold) - kDamping * qd);
  }
};

using HingeHold = BasicHingeHold<double>;

}  // namespace gaitlab
