// Pairs of bodies from an SRDF file, the companion of a URDF file in which MoveIt's set-up writes links that never collide.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/model/body_pairs.h"

namespace gaitlab::interchange {

/// Pairs of the elements `disable_collisions`, by the names of bodies in the module, each once and without pairs of one body.
/// `body_of_link`: body of each link of the robot `urdf`. The rest of the file is not read. Throws InputError for a file that
/// cannot be read or has no element `robot`; a pair without a link, and a link that the robot lacks, are problems.
std::vector<BodyPair> srdf_pairs(const std::string& file, const std::string& urdf,
                                 const std::map<std::string, std::string>& body_of_link, Problems& problems);

}  // namespace gaitlab::interchange
