// Module file from a robot in URDF or MJCF.
#pragma once
#include <string>
#include <vector>

#include "core/model/body_pairs.h"
#include "interchange/robot_bodies.h"
#include "interchange/robot_note.h"

namespace gaitlab::interchange {

struct RobotModule {
  std::string text;                   ///< content of the module file, without `may_overlap`
  bool driven = false;                ///< true if a hinge has a motor
  std::vector<BodyPair> may_overlap;  ///< bodies whose contact the file excludes
  std::vector<RobotNote> notes;       ///< differences from the file, in its order; also in the head of the text
};

/// Module file, named `name`, of the robot in a file.
///
/// URDF, read by urdfdom: revolute and continuous joints are the hinges; links that fixed joints connect are one body, in the
/// frame of the first. A link's collision is its shapes (a mesh is its hull, as urdf_shapes.h says), or its visual if it has no
/// collision. A joint's effort and velocity are torque at rest and no-load speed of its servo; effort 0 means a hinge without a
/// motor. MJCF, compiled by libmujoco: mjcf_bodies.h.
///
/// Numbers are written as the shortest texts that are read back as the same doubles. Throws InputError with a problem, at its
/// line, for everything that a module cannot contain.
RobotModule module_of_robot(const std::string& file, const std::string& name, const ImportOptions& options = {});

}  // namespace gaitlab::interchange
