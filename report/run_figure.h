// figure.svg of a run.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/plugin/legs.h"
#include "report/summary.h"

namespace gaitlab::report {

/// The most loaded joint on twin axes, and the robot from the side at the last five seconds.
///
/// A robot that walks on legs (find_legs gives four or more, contacts and a ground are on) is shown by its central spine joint
/// instead (the paper's figure 14), the footfalls of its legs and five side views a fifth of a period apart: the last period of
/// the limit cycle, at most 4 s; 2 s without one. A leg stands where it carries more than 2 % of the weight; its duty factor is
/// over as many whole periods as the last 8 s hold (without a limit cycle, or with a longer period, over all of them).
std::string run_figure(const Scenario& scenario, const Recording& record, const Summary& summary);

/// The joint the paper's figure 13 points to. The spine is every module that is in no leg. Of its joints that turn about y
/// (within 25 degrees, at zero angles: they bend the spine up and down; all where there is none), the one nearest, along x, to
/// the middle between the foremost and the rearmost joint of the spine; of two as near (to a millimetre) the one further to the
/// front. Not the most loaded of the spine: in our hexapod that is the foremost one, where the front legs are docked.
std::size_t central_spine_joint(const RobotInfo& robot, const std::vector<Leg>& legs);

}  // namespace gaitlab::report
