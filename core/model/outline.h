// Boxes around the shapes of a robot and of its modules.
#pragma once
#include <vector>

#include "core/model/robot.h"

namespace gaitlab {

/// Edges of the box around all shapes of a robot at zero angles, along the axes of the base frame, m. 0 without shapes.
Vec3 outline_edges(const Robot& robot);
/// Edges of the box around the shapes of each module, as above.
std::vector<Vec3> outline_edges_of_modules(const Robot& robot);

}  // namespace gaitlab
