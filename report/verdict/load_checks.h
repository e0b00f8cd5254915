// Checks of a verdict on what docks and feet bore (Recording::loads).
#pragma once
#include <vector>

#include "report/verdict/verdict.h"

namespace gaitlab::report {

enum class DockQuantity { tension, shear, bending, torsion };

/// What the docks of the modules hold, by the numbers of modules, N or N m: the smaller limit of the connectors of both faces.
/// NaN, and all where it is empty: nobody states it.
std::vector<double> dock_limits(const Robot& robot, DockQuantity quantity);

/// The largest load of any dock in the whole run against `limits`: of the dock that comes nearest to its limit, or where no
/// limit is stated the largest at all, not judged. Of a tension only the pull counts, of a torsion either way.
void judge_docks(const Scenario& scenario, const Recording& record, DockQuantity quantity, const std::vector<double>& limits,
                 Check& made);

/// How far the robot's weight slid on its feet over how far the robot went, in the judged window; warns above Limits::slip.
void judge_slip(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made);

/// The least distance of the centre of mass from the edge of the support polygon, inside positive. A note: it has no limit and
/// always passes, since a gait may well be a fall that the next step catches.
void judge_stability(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made);

}  // namespace gaitlab::report
