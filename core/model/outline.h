// Box around the shapes of a robot.
#pragma once
#include <optional>

#include "core/model/robot.h"

namespace gaitlab {

/// Edges of the box around all shapes of a robot at zero angles, or of one of its modules, along the axes of the base frame, m.
/// 0 without shapes.
Vec3 outline_edges(const Robot& robot, std::optional<std::size_t> module = {});

}  // namespace gaitlab
