// Module file from a robot in URDF.
#pragma once
#include <string>
#include <vector>

#include "interchange/urdf_note.h"

namespace gaitlab::interchange {

struct UrdfModule {
  std::string text;             ///< content of the module file
  bool driven = false;          ///< true if a hinge has a motor
  std::vector<UrdfNote> notes;  ///< differences from the URDF, in the order of the file; also in the head of the text
};

/// Module file, named `name`, of the robot in the URDF file `file`, read by urdfdom. Revolute and continuous joints are its
/// hinges; links that fixed joints connect are one body, in the frame of the first. Boxes, cylinders and spheres of a link's
/// collision are its shapes, or those of its visual if it has no collision. A joint's effort and velocity are torque at rest
/// and no-load speed of its servo; effort 0 means a hinge without a motor. Numbers are written as the shortest texts that are
/// read back as the same doubles. Throws InputError with a problem, at its line, for everything that a module cannot contain.
/// Joints whose names match a name or pattern of `locked` are fixed at 0.
UrdfModule module_of_urdf(const std::string& file, const std::string& name, const std::vector<std::string>& locked = {});

}  // namespace gaitlab::interchange
