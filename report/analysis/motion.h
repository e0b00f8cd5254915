// Motion of the robot as a whole and the limit cycle of its joints, at control ticks, so that results do not depend on
// trace.period. Folders of older formats have them at the rows of the trace.
#pragma once
#include <string>
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Columns of the motion; empty if the recording does not have them. The recording outlives this object.
struct Motion {
  Series t, x, y, z;      ///< s; m, of the centre of mass
  Series qw, qx, qy, qz;  ///< of the base
};

Motion motion(const Recording& record);

/// Turn of the base about world z from one row of the motion to another, rad: the sum of the twists from row to row, which is
/// defined for any pitch of the base.
double heading_change(const Motion& motion, std::size_t from, std::size_t to);

/// Whether the motion is at control ticks: the recording has set points, centre of mass and load there.
bool motion_of_ticks(const Recording& record);

/// `in this older folder limit cycle, judged time and the robot's way are of the trace's rows, one per 50 ms ...`; empty: they
/// are at control ticks, or rows_sentence covers them.
std::string motion_sentence(const Recording& record);

/// Normal forces of the ground that carry the robot, at the rows of the motion, N; empty: not known, the base does not float,
/// or the robot has no contact elements.
std::vector<Series> ground_loads(const Scenario& scenario, const Recording& record);

/// Set points of the joints with a motor that have one, at the rows of the motion, rad.
std::vector<Series> set_points(const Scenario& scenario, const Recording& record);

/// Limit cycle of all angles and set points; of the set points alone.
MotionCycle limit_cycle(const Scenario& scenario, const Recording& record);
MotionCycle set_point_cycle(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
