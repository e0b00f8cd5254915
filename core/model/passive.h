// Spring, damper and friction of a hinge without a motor. Kernels include this file. It may therefore include the standard
// library only.
#pragma once

namespace gaitlab {

/// A spring, a damper and dry friction (core/laws/passive_hinge.h).
struct Passive {
  double stiffness = 0;         ///< N m/rad
  double rest = 0;              ///< rad; angle without spring torque
  double damping = 0;           ///< N m s/rad
  double friction = 0;          ///< N m, dry
  double friction_speed = 0.1;  ///< rad/s; friction is viscous below this speed
};

}  // namespace gaitlab
