// Moving joints of a URDF robot that a module has as fixed ones.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "interchange/robot_note.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

/// The joints whose child is joined to its parent at position 0: fixed ones, those whose name matches a name or pattern of
/// `locked`, and those that move only links without mass, such as the frame at the tip of an arm. Adds a note for each
/// that moves in the file, and a problem for each of `locked` that matches none.
std::set<const urdf::Joint*> joined_joints(const UrdfText& urdf, const std::vector<std::string>& locked,
                                           std::vector<RobotNote>& notes, Problems& problems);

}  // namespace gaitlab::interchange
