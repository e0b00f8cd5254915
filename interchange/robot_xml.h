// Common parts of the writers of URDF and MJCF: numbers, cylinder axes, and limits of motors.
#pragma once
#include <string>
#include <vector>

#include "core/dynamics/body_tree.h"
#include "core/plugin/actuator.h"
#include "core/scenario/scenario.h"
#include "interchange/xml.h"

namespace gaitlab::interchange {

/// Numbers separated by spaces. Each is the shortest text that is read back as the same double, in any locale.
std::string text(std::initializer_list<double> numbers);
std::string text(const std::vector<double>& numbers);
inline std::string text(const Vec3& v) { return text({v.x(), v.y(), v.z()}); }

/// Rotation of a cylinder: its axis is z in URDF and MJCF, and y in gaitlab.
Mat3 y_from_z();

/// Limits of a joint's motor in the terms of URDF and MJCF, on the side of the joint.
struct MotorLimits {
  double effort = 0;    ///< N m, torque at rest under the largest command; infinity if not limited
  double speed = 0;     ///< rad/s, no-load speed under the largest command; 0 if there is none
  double armature = 0;  ///< kg m^2, inertia of the rotor
  JointFriction friction;
};
/// Motor limits of each joint; empty without an actuator.
std::vector<MotorLimits> motor_limits(const Scenario& scenario);

/// Text of a comment on the parts of the scenario that neither URDF nor MJCF can represent.
std::string left_out(const Scenario& scenario);

}  // namespace gaitlab::interchange
