// Module file from a robot in URDF.
#pragma once
#include <string>
#include <vector>

#include "interchange/urdf_note.h"

namespace gaitlab::interchange {

/// Choices beside a URDF file.
struct UrdfOptions {
  std::vector<std::string> locked = {};  ///< names and patterns of joints that are fixed at 0
  std::string meshes = {};               ///< folder of mesh files; "" for none
};

struct UrdfModule {
  std::string text;             ///< content of the module file
  bool driven = false;          ///< true if a hinge has a motor
  std::vector<UrdfNote> notes;  ///< differences from the URDF, in the order of the file; also in the head of the text
};

/// Module file, named `name`, of the robot in the URDF file `file`, read by urdfdom. Revolute and continuous joints are its
/// hinges; links that fixed joints connect are one body, in the frame of the first. A link's collision is its shapes (a mesh is
/// its hull, as urdf_shapes.h says), or its visual if it has no collision. A joint's effort and velocity are torque at rest
/// and no-load speed of its servo; effort 0 means a hinge without a motor. Numbers are written as the shortest texts that are
/// read back as the same doubles. Throws InputError with a problem, at its line, for everything that a module cannot contain.
UrdfModule module_of_urdf(const std::string& file, const std::string& name, const UrdfOptions& options = {});

}  // namespace gaitlab::interchange
