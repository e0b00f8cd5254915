// Natural scales of trace columns. A column whose range is below a millionth of its scale counts as constant.
#pragma once
#include <vector>

#include "core/recording/trace.h"
#include "core/scenario/scenario.h"

namespace gaitlab::golden {

/// Natural scale of every column, in its unit: 1 for a quaternion or an angle, the robot's extent for a length, and its weight
/// (at 9.81 m/s^2 if there is no gravity) for a force. For torque, current and voltage it is the torque at rest, the current
/// limit and the largest voltage of the joint's motor, or of the strongest motor if the column belongs to no motor. Without
/// such motors the torque is weight times extent. 0 for a unit without a natural scale.
std::vector<double> natural_scales(const Scenario& scenario, const ColumnList& columns);

}  // namespace gaitlab::golden
