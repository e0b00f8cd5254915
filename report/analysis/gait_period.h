// Period of the set points of a gait.
#pragma once
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Number of set-point periods that a run must contain if its motion does not settle to a limit cycle.
inline constexpr double kPeriodsNeeded = 3;

/// Period of the set points, s; 0 if they do not repeat. It is found in the recorded set points. If the run is too short, it is
/// found by simulating the CPG alone for longer, once per CPG. If feedback changes the set points, or the CPG is not a class of
/// C++, it is the inverse of the least frequency (Hz) among the CPG's settings.
double set_point_period(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
