// Hinges of a URDF robot with their motors, and motors chosen for joints without a limit.
#pragma once
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "interchange/urdf_note.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

struct UrdfHinge {
  HingeType hinge;               ///< parent and child: indices of UrdfBodies::bodies
  double effort = 0, speed = 0;  ///< motor's torque at rest, N m, and no-load speed, rad/s; 0 without a motor
  double dry = 0, viscous = 0;   ///< friction of a driven joint, N m, N m s/rad
  bool no_effort = false;        ///< true if the file does not state the torque of the motor
  bool no_speed = false;         ///< true if the file does not state its speed
  std::string source = {};       ///< of torque and speed, if one of them was chosen
  const urdf::Joint* of = nullptr;
};

/// Reads motor and friction of a joint, or its passive hinge for an effort of 0. Other efforts below 1e-6 N m or
/// from 1e5 N m on, and velocities below 1e-3 rad/s or above 1000 rad/s, do not describe a motor, and count as not stated. Adds
/// a problem for negative numbers, and for friction above 1e9.
void read_motor(const urdf::Joint& joint, const UrdfText& urdf, UrdfHinge& hinge, Problems& problems);

/// Chooses the torques and speeds that the file does not state, with a note each; adds a note on hinges without a motor. Torque
/// at rest: twice M g L, where M is the mass of all bodies that the hinge moves, and L the distance from its axis to the
/// farthest of their centres of mass if the hinges between are stretched, or their largest radius of gyration if that is
/// longer. No-load speed: 20 rad/s. Bodies must be in an order in which each parent is before its children. Adds a problem for
/// a torque above 1e9 N m.
void choose_motors(const std::vector<BodyType>& bodies, const UrdfText& urdf, std::vector<UrdfHinge>& hinges,
                   std::vector<UrdfNote>& notes, Problems& problems);

}  // namespace gaitlab::interchange
