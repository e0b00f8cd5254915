// Hinge of a robot file with its motor.
#pragma once
#include <string>
#include <vector>

#include "core/model/module_type.h"

namespace gaitlab::interchange {

struct RobotHinge {
  HingeType hinge;               ///< parent and child: indices of RobotBodies::bodies
  double effort = 0, speed = 0;  ///< motor's torque at rest, N m, and no-load speed, rad/s; 0 without a motor
  double dry = 0, viscous = 0;   ///< friction of a driven joint, N m, N m s/rad
  double rotor_inertia = 0;      ///< kg m^2, at the joint
  bool no_effort = false;        ///< true if the file does not state the torque of the motor
  bool no_speed = false;         ///< true if the file does not state its speed
  std::string source = {};       ///< of torque and speed, if one of them was chosen
};

inline constexpr double kMostTorque = 1e9;  ///< N m, that the servo permits; also of friction, N m s/rad
inline constexpr double kChosenSpeed = 20;  ///< rad/s, of a motor whose speed the file does not state

/// Torque at rest, N m, of a motor for each hinge whose file does not state it: twice M g L, where M is the mass of all bodies
/// that the hinge moves, and L the distance from its axis to the farthest of their centres of mass if the hinges between are
/// stretched, or their largest radius of gyration if that is longer; rounded to three digits. Bodies must be in an order in
/// which each parent is before its children.
std::vector<double> holding_torques(const std::vector<BodyType>& bodies, const std::vector<RobotHinge>& hinges);

}  // namespace gaitlab::interchange
