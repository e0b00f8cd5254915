// figure.svg of a run.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/plugin/legs.h"
#include "report/analysis/summary.h"

namespace gaitlab::report {

/// The figure of a run. The joints of `figure.joints` on twin axes, or the most loaded one, and the robot from the side of its
/// path (from above if its joints turn about the vertical) at the last five seconds; with a limit cycle five views a fifth of a
/// period apart.
///
/// For a robot that walks on legs (find_legs gives four or more, contacts and a ground are on) also its central spine joint
/// (the paper's figure 14), the footfalls of its legs, and always the views over a period: the last one of the limit cycle, at
/// most 4 s; 2 s without one. A leg stands if it carries more than 2 % of the weight; its duty factor is over the whole periods
/// in the last 8 s (without a limit cycle, or with a longer period, over all of them).
std::string run_figure(const Scenario& scenario, const Recording& record, const Summary& summary);

/// The joint marked in the paper's figure 13. The spine consists of the modules that are not in a leg. Of its joints that turn
/// about y (within 25 degrees, at zero angles: they bend the spine up and down; if there is none, of all its joints), the one
/// nearest, along x, to the middle between the foremost and the rearmost joint of the spine; of two as near (to a millimetre)
/// the one further to the front. Not the most loaded of the spine: in our hexapod that is the foremost one, where the front
/// legs are docked.
std::size_t central_spine_joint(const RobotInfo& robot, const std::vector<Leg>& legs);

}  // namespace gaitlab::report
