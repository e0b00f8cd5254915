// Bodies and hinges of a robot in MJCF.
#pragma once
#include "interchange/mjcf_text.h"
#include "interchange/robot_bodies.h"

namespace gaitlab::interchange {

/// The robot is the tree of the world with the most hinges (docs/modules.md, "A module from MJCF"). Adds a problem for joints
/// that are neither hinges nor locked, and for bodies without mass; the bodies and hinges are then not valid. Throws InputError
/// with the message of libmujoco.
RobotBodies mjcf_bodies(MjcfText& text, const ImportOptions& options, Problems& problems);

}  // namespace gaitlab::interchange
