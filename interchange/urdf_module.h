// Module file from a robot in URDF.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::interchange {

struct UrdfModule {
  std::string text;                ///< content of the module file
  bool driven = false;             ///< true if a hinge has a motor
  std::vector<std::string> notes;  ///< parts of the URDF that the module file lacks and that have no effect on the motion
};

/// Module file, named `name`, of the robot in the URDF file `file`, read by urdfdom. Revolute and continuous joints are its
/// hinges; links that fixed joints connect are one body, in the frame of the first; boxes, cylinders and spheres are its
/// shapes. A joint's effort and velocity are torque at rest and no-load speed of its servo; effort 0 means a hinge without a
/// motor. Numbers are written as the shortest texts that are read back as the same doubles. Throws InputError with a problem,
/// at its line, for everything that a module cannot contain.
UrdfModule module_of_urdf(const std::string& file, const std::string& name);

}  // namespace gaitlab::interchange
