// Period of the set points of a gait.
#pragma once
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Number of periods that show a gait whose motion does not settle to a limit cycle.
inline constexpr double kPeriodsNeeded = 3;

/// Period of the set points, s: as recorded; for a run too short to show one, that of the CPG simulated alone for longer; if
/// feedback changes the set points, by the least frequency (Hz) of its settings. 0: they do not repeat.
double set_point_period(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
