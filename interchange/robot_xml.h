// Common parts of the robot formats: numbers that are read back as the same double, poses at zero angles, motors as limits.
#pragma once
#include <string>
#include <vector>

#include "core/dynamics/body_tree.h"
#include "core/scenario/scenario.h"
#include "interchange/xml.h"

namespace gaitlab::interchange {

/// Numbers separated by spaces, each the shortest text that is read back as the same double, in any locale.
std::string text(std::initializer_list<double> numbers);
std::string text(const std::vector<double>& numbers);
inline std::string text(const Vec3& v) { return text({v.x(), v.y(), v.z()}); }

/// Rotation from axis z, a cylinder's in the other formats, to y, its axis here.
Mat3 y_from_z();

/// Limits of a joint's motor in the terms of other formats: torque at rest under the largest command, speed without load, and
/// inertia of its rotor on the joint.
struct MotorLimits {
  double effort = 0;    ///< N m; infinity: no limit
  double speed = 0;     ///< rad/s; 0: the torque does not depend on speed
  double armature = 0;  ///< kg m^2
};
/// One per joint; empty without actuator.
std::vector<MotorLimits> motor_limits(const Scenario& scenario);

/// Parts of the scenario that no robot format holds, as a comment.
std::string left_out(const Scenario& scenario);

}  // namespace gaitlab::interchange
