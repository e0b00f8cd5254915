// figure.svg of a run.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/plugin/legs.h"
#include "report/analysis/summary.h"

namespace gaitlab::report {

/// The joints of `figure.joints` on twin axes, or the most loaded one, and the robot from the side of its way (from above where
/// its joints turn about the vertical) at the last five seconds; with a limit cycle five views a fifth of a period apart.
///
/// Of a robot that walks on legs (find_legs gives four or more, contacts and a ground are on) also its central spine joint (the
/// paper's figure 14), the footfalls of its legs, and always the views over a period: the last one of the limit cycle, at most
/// 4 s; 2 s without one. A leg stands where it carries more than 2 % of the weight; its duty factor is over as many whole
/// periods as the last 8 s hold (without a limit cycle, or with a longer period, over all of them).
std::string run_figure(const Scenario& scenario, const Recording& record, const Summary& summary);

/// The joint the paper's figure 13 points to. The spine is every module that is in no leg. Of its joints that turn about y
/// (within 25 degrees, at zero angles: they bend the spine up and down; all where there is none), the one nearest, along x, to
/// the middle between the foremost and the rearmost joint of the spine; of two as near (to a millimetre) the one further to the
/// front. Not the most loaded of the spine: in our hexapod that is the foremost one, where the front legs are docked.
std::size_t central_spine_joint(const RobotInfo& robot, const std::vector<Leg>& legs);

}  // namespace gaitlab::report
