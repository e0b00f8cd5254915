// Motors of the joints of a URDF robot, and those chosen for joints without a limit.
#pragma once
#include "interchange/robot_bodies.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

/// Reads motor and friction of a joint, or its passive hinge for an effort of 0. Other efforts below 1e-6 N m or
/// from 1e5 N m on, and velocities below 1e-3 rad/s or above 1000 rad/s, do not describe a motor, and count as not stated. Adds
/// a problem for negative numbers, and for friction above 1e9.
void read_motor(const urdf::Joint& joint, const UrdfText& urdf, RobotHinge& hinge, Problems& problems);

/// Chooses the torques (holding_torques) and speeds (kChosenSpeed) that the file does not state, with a note each; adds a note
/// on hinges without a motor. Adds a problem for a torque above kMostTorque.
void choose_motors(RobotBodies& made, const UrdfText& urdf, Problems& problems);

}  // namespace gaitlab::interchange
