// Settings for the friction of a driven joint, shared by all actuators.
#pragma once
#include "core/plugin/actuator.h"

namespace gaitlab::actuators {

/// Part of an actuator's Settings.
struct FrictionKeys {
  PerJoint dry_friction{0}, viscous_friction{0};  ///< N m, N m s/rad; at the joint
  void fields(Fields& f);
  [[nodiscard]] JointFriction friction_of(std::size_t joint) const { return {dry_friction[joint], viscous_friction[joint]}; }
};

}  // namespace gaitlab::actuators
