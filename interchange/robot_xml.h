// What the robot formats share: numbers that read back to the same double, poses at zero angles, motors as limits.
#pragma once
#include <string>
#include <vector>

#include "core/dynamics/body_tree.h"
#include "core/scenario/scenario.h"
#include "interchange/xml.h"

namespace gaitlab::interchange {

/// Numbers apart by spaces, each the shortest text that reads back to the same double, whatever the locale.
std::string text(std::initializer_list<double> numbers);
std::string text(const std::vector<double>& numbers);
inline std::string text(const Vec3& v) { return text({v.x(), v.y(), v.z()}); }

/// For a cylinder whose axis is z elsewhere and y here.
Mat3 y_from_z();

/// A joint's motor as others know motors: what it gives at rest under the largest command, the speed at which it gives nothing,
/// and the inertia of its rotor on the joint.
struct MotorLimits {
  double effort = 0;    ///< N m; infinity: as much as is asked
  double speed = 0;     ///< rad/s; 0: gives its torque at every speed
  double armature = 0;  ///< kg m^2
};
/// One per joint; empty without actuator.
std::vector<MotorLimits> motor_limits(const Scenario& scenario);

/// What of the scenario no robot format holds, for a comment.
std::string left_out(const Scenario& scenario);

}  // namespace gaitlab::interchange
