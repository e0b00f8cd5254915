// Bodies and hinges of a robot in URDF.
#pragma once
#include "interchange/robot_bodies.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

/// Adds a problem for everything that a module cannot contain; the bodies and hinges are then not valid.
RobotBodies urdf_bodies(const UrdfText& urdf, const ImportOptions& options, Problems& problems);

}  // namespace gaitlab::interchange
