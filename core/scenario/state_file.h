// The state file of `gaitlab dynamics`: JSON, read as strictly as a scenario.
#pragma once
#include <string>
#include <vector>

#include "core/dynamics/wrench.h"
#include "core/model/kinematics.h"

namespace gaitlab {

/// Input of one evaluation of the dynamics.
struct DynamicsInput {
  RobotState state;
  Acceleration acceleration;  ///< inverse dynamics only
  std::vector<double> tau;    ///< N m; forward dynamics only
  std::vector<BodyWrench> wrenches;
  SourceLocation place = {};  ///< place of the joints' angles: `q` in the file, or the file
};

/// {q, qd, qdd, tau: a list, a number or {default, JOINT: x}; base: {position, quaternion: [w, x, y, z], velocity,
/// angular_velocity, acceleration, angular_acceleration}; wrenches: [{body, point, force, torque}]}; world axes, SI; every key
/// may be absent. Defaults: q, qd and the base of `start`, for a wrench's point the origin of its body's frame, else 0. Throws
/// InputError with every finding at FILE:LINE:COL: not JSON, unknown key, wrong shape, an unknown body, a quaternion whose
/// length is not 1 (within 1e-6; it is normalised), a motion that the base cannot make.
DynamicsInput read_state_file(const std::string& path, const Robot& robot, Base base, const RobotState& start);

}  // namespace gaitlab
