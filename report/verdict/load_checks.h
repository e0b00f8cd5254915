// Checks of a verdict on the loads of docks and feet (Recording::loads).
#pragma once
#include <vector>

#include "report/verdict/verdict.h"

namespace gaitlab::report {

enum class DockQuantity { tension, shear, bending, torsion };

/// Load limits of the docks, by the numbers of modules, N or N m: the smaller limit of the connectors of both faces. NaN, and
/// all if the result is empty: not stated.
std::vector<double> dock_limits(const Robot& robot, DockQuantity quantity);

/// Compares the largest load of docks in the whole run with `limits`: that of the dock with the least margin or, if no limit is
/// stated, the largest one, not judged. For tension only pull counts, for torsion both directions.
void judge_docks(const Scenario& scenario, const Recording& record, DockQuantity quantity, const std::vector<double>& limits,
                 Check& made);

/// Compares the slip of the robot's weight over its feet with the robot's path, in the judged window; warns above Limits::slip.
void judge_slip(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made);

/// Least distance of the centre of mass from the edge of the support polygon, inside positive. A note: it has no limit and
/// always passes, because a gait may be a fall that the next step catches.
void judge_stability(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made);

}  // namespace gaitlab::report
