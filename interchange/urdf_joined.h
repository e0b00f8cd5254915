// Moving joints of a URDF robot that a module has as fixed ones.
#pragma once
#include <set>
#include <vector>

#include "interchange/urdf_note.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

/// The joints whose child is joined to its parent at position 0: fixed ones, and those that move nothing but links without
/// mass, such as the frame at the tip of an arm. Adds a note for each of the latter.
std::set<const urdf::Joint*> joined_joints(const UrdfText& urdf, std::vector<UrdfNote>& notes);

}  // namespace gaitlab::interchange
