// The section `ground`: plane, boxes or heightfield under the robot.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab {

struct GroundFields {
  Ground& ground;
  bool writing = false;  ///< only the keys of the ground's type, and those of a self-contained file
  void fields(Fields& f);
};

/// Checks and completes the section once it is read: keys of another type, a box's default friction, masses, the grid's file
/// (relative to `folder`), missing keys. `section`: the node of `ground`.
void finish_ground(const Node& section, const std::string& folder, Scenario& scenario, Problems& problems);

}  // namespace gaitlab
