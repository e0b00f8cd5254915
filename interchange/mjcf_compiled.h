// Compilation of an MJCF text with the mesh files that a module needs.
#pragma once
#include <vector>

#include "interchange/mjcf_model.h"
#include "interchange/mjcf_text.h"
#include "interchange/robot_note.h"

namespace gaitlab::interchange {

/// The robot of the text. Only mesh files of geoms that collide, or that give a body its inertia, are read; a first compilation
/// without any shows which. Attributes of MuJoCo 3 without effect on a module are taken out of `text`. Each warning of
/// libmujoco is a note. Throws InputError with the message of libmujoco, and for a NaN.
MjcfRobot compiled(MjcfText& text, std::vector<RobotNote>& notes);

}  // namespace gaitlab::interchange
