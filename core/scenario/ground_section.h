// The section `ground`, with the plane, boxes or heightfield under the robot.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab {

struct GroundFields {
  Ground& ground;
  bool writing = false;  ///< true to visit only the keys of the ground's type, and the keys of a self-contained file
  void fields(Fields& f);
};

/// Checks and completes the ground after the section has been read. Checks keys of another type, masses and missing keys, sets
/// the default friction of boxes, and reads the file of a heightfield. `section` is the node of `ground`. File paths are
/// relative to `folder`.
void finish_ground(const Node& section, const std::string& folder, Scenario& scenario, Problems& problems);

}  // namespace gaitlab
