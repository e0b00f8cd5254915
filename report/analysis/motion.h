// How the robot moves as a whole and what repeats in its joints, at control ticks: nothing here depends on trace.period. Older
// folders have it at the rows of the trace.
#pragma once
#include <string>
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Each is empty where the recording does not have it. The recording outlives it.
struct Motion {
  Series t, x, y, z;      ///< s; m, of the centre of mass
  Series qw, qx, qy, qz;  ///< of the base
};

Motion motion(const Recording& record);

/// rad, turn of the base about world z from one row of the motion to another: the sum of the twists from row to row, which is
/// defined however far the base is pitched.
double heading_change(const Motion& motion, std::size_t from, std::size_t to);

/// Whether all this is of control ticks: the recording has set points, centre of mass and load there.
bool motion_of_ticks(const Recording& record);

/// `in this older folder limit cycle, judged time and the robot's way are of the trace's rows, one per 50 ms ...`; empty: they
/// are of control ticks, or rows_sentence says so of all numbers.
std::string motion_sentence(const Recording& record);

/// N, at the rows of the motion: normal forces of the ground, whose sum the robot rests on; empty: nothing is known of them,
/// the base does not float, or the robot has no contact elements.
std::vector<Series> ground_loads(const Scenario& scenario, const Recording& record);

/// rad, at the rows of the motion: of the joints with a motor that have one.
std::vector<Series> set_points(const Scenario& scenario, const Recording& record);

/// Of all angles and set points; of the set points alone.
MotionCycle limit_cycle(const Scenario& scenario, const Recording& record);
MotionCycle set_point_cycle(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
