// Motion of the robot as a whole and limit cycle of its joints. They are computed at control ticks, so that results do not
// depend on trace.period.
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

/// Normal force of the ground on the robot at the rows of the motion, N. Empty if it is not known, the base is not floating, or
/// the robot has no contact elements.
Series ground_load(const Scenario& scenario, const Recording& record);

/// Recorded set points of the joints with a motor, at the rows of the motion, rad.
std::vector<Series> set_points(const Scenario& scenario, const Recording& record);

/// Limit cycle of all angles and set points together, and of the set points alone, after the last change of the run (section
/// `at`).
MotionCycle limit_cycle(const Scenario& scenario, const Recording& record);
MotionCycle set_point_cycle(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
