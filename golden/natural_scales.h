// Natural scales of trace columns: sizes below whose millionth a column of the robot is constant.
#pragma once
#include <vector>

#include "core/recording/trace.h"
#include "core/scenario/scenario.h"

namespace gaitlab::golden {

/// Natural scale of every column, in its unit: 1 of a quaternion and an angle, the extent of the robot of a length, its weight
/// (at 9.81 m/s^2 if there is no gravity) of a force; the torque at rest, the current limit and the largest voltage of the
/// joint's motor, or of the strongest motor if the column belongs to no motor. Without such motors the torque is weight times
/// extent. 0 for a unit without a natural scale.
std::vector<double> natural_scales(const Scenario& scenario, const ColumnList& columns);

}  // namespace gaitlab::golden
