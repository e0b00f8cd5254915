// The state file of `gaitlab dynamics`, a JSON file that is read as strictly as a scenario.
#pragma once
#include <string>
#include <vector>

#include "core/dynamics/wrench.h"
#include "core/model/kinematics.h"

namespace gaitlab {

/// Input of one evaluation of the dynamics.
struct DynamicsInput {
  RobotState state;
  Acceleration acceleration;  ///< used for inverse dynamics only
  std::vector<double> tau;    ///< joint torques, N m; used for forward dynamics only
  std::vector<BodyWrench> wrenches;
  SourceLocation place = {};  ///< place of the joint angles: key `q` in the file, or the file
};

/// Reads {q, qd, qdd, tau: a list, a number or {default, JOINT: x}; base: {position, quaternion: [w, x, y, z], velocity,
/// angular_velocity, acceleration, angular_acceleration}; wrenches: [{body, point, force, torque}]}, in world axes and SI
/// units. Every key may be absent. The defaults of q, qd and base are the values in `start`; the default point of a wrench is
/// the origin of the frame of its body; all other defaults are 0. Throws InputError with every problem found at FILE:LINE:COL:
/// text that is not JSON, an unknown key, a wrong shape, an unknown body, or a motion that the base cannot make. A quaternion
/// whose length differs from 1 by more than 1e-6 is also a problem; any other quaternion is normalised.
DynamicsInput read_state_file(const std::string& path, const Robot& robot, Base base, const RobotState& start);

}  // namespace gaitlab
