// Motion of the robot as a whole and limit cycle of its joints. They are computed at control ticks, so that results do not
// depend on trace.period, or in folders of older formats at the rows of the trace.
#pragma once
#include <string>
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Columns of the motion, empty if the recording does not contain them. The recording must outlive this object.
struct Motion {
  Series t, x, y, z;      ///< time, s; position of the centre of mass, m
  Series qw, qx, qy, qz;  ///< orientation of the base
};

Motion motion(const Recording& record);

/// Turn of the base about world z from one row of the motion to another, rad. It is the sum of the twists between consecutive
/// rows, which is defined at any pitch of the base.
double heading_change(const Motion& motion, std::size_t from, std::size_t to);

/// True if the motion is at control ticks, because the recording contains set points, centre of mass and load there.
bool motion_of_ticks(const Recording& record);

/// Text `in this older folder limit cycle, judged time and the robot's way are of the trace's rows, one per 50 ms ...`. Empty
/// if the motion is at control ticks, or if rows_sentence covers it.
std::string motion_sentence(const Recording& record);

/// Normal forces of the ground on the robot at the rows of the motion, N. Empty if they are not known, the base is not
/// floating, or the robot has no contact elements.
std::vector<Series> ground_loads(const Scenario& scenario, const Recording& record);

/// Recorded set points of the joints with a motor, at the rows of the motion, rad.
std::vector<Series> set_points(const Scenario& scenario, const Recording& record);

/// Limit cycle of all angles and set points together, and of the set points alone, after the last change of the run (section
/// `at`).
MotionCycle limit_cycle(const Scenario& scenario, const Recording& record);
MotionCycle set_point_cycle(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
