// Torque between motor and link of a gear with play: two flanks, each of which only pushes.
#pragma once
#include "core/laws/hinge_stop.h"
#include "core/model/play.h"

namespace gaitlab {

/// A stop (core/laws/hinge_stop.h) at each end of the play, for the angle of the motor relative to the link:
///     torque = -k (d - d_lim) - c dd        |d| > width / 2, and 0 if this torque would pull
/// d, dd: angle and speed of the motor (geared, at the joint) minus those of the link, rad, rad/s; torque on the motor, N m,
/// and its negative on the link. c = k cs / ks: ratio of damping and stiffness as that of a stop (chosen). T: double or lanes.
template <class T>
struct BasicGearPlay {
  T half = 0.0;       ///< half of the play, rad
  T stiffness = 0.0;  ///< k, N m/rad

  [[nodiscard]] T damping() const { return T(kStopDamping / kStopStiffness) * stiffness; }  ///< c, N m s/rad
  [[nodiscard]] BasicHingeStop<T> at(const T& d, const T& dd) const {
    return BasicHingeStop<T>::at(d, dd, -half, half, stiffness, damping());
  }
};

using GearPlay = BasicGearPlay<double>;

inline GearPlay law(const Play& play) { return {0.5 * play.width, play.stiffness}; }

}  // namespace gaitlab
