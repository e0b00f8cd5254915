// Period of the set points of a gait.
#pragma once
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Periods that show a gait, where its motion does not settle to a limit cycle.
inline constexpr double kPeriodsNeeded = 3;

/// s: period of the set points: as recorded; of a run too short to show one, that of the CPG alone, which goes on after the
/// run; where feedback changes what it does, by the least frequency (Hz) of its settings. 0: they do not repeat.
double set_point_period(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
