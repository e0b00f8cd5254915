// The section `ground`: what the robot stands on.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab {

struct GroundFields {
  Ground& ground;
  bool writing = false;  ///< only the keys of the ground's type, and those that a self-contained file has
  void fields(Fields& f);
};

/// What only the whole section shows, once it is read: keys of another type, a box's default friction, masses, the grid's file
/// (relative to `folder`), what is missing. `section`: the node of `ground`.
void finish_ground(const Node& section, const std::string& folder, Scenario& scenario, Problems& problems);

}  // namespace gaitlab
