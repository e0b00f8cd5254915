// The state file of `gaitlab dynamics`: JSON, read as strictly as a scenario.
#pragma once
#include <string>
#include <vector>

#include "core/dynamics/wrench.h"
#include "core/model/kinematics.h"

namespace gaitlab {

/// What one evaluation of the dynamics starts from.
struct DynamicsInput {
  RobotState state;
  Acceleration acceleration;  ///< inverse dynamics only
  std::vector<double> tau;    ///< N m; forward dynamics only
  std::vector<BodyWrench> wrenches;
  SourceLocation place = {};  ///< of what the joints' angles come from: `q` in the file, or the file
};

/// {q, qd, qdd, tau: a list, a number or {default, JOINT: x}; base: {position, quaternion: [w, x, y, z], velocity,
/// angular_velocity, acceleration, angular_acceleration}; wrenches: [{body, point, force, torque}]}; world axes, SI; every key
/// may be missing: q, qd and the base are then those of `start`, a wrench's point is the origin of its body's frame, the rest
/// is 0. Throws InputError with every finding at FILE:LINE:COL: not JSON, unknown key, wrong shape, no such body, a quaternion
/// whose length is not 1 (within 1e-6; it is normalised), a motion that the base cannot make.
DynamicsInput read_state_file(const std::string& path, const Robot& robot, Base base, const RobotState& start);

}  // namespace gaitlab
