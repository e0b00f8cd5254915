// The figure of a run, written as figure.svg: a recipe of the panels that suit the robot.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/robot_info.h"
#include "report/analysis/summary.h"

namespace gaitlab::report {

/// SVG of a run's figure. It shows the joints of `figure.joints`, or else the most loaded joint, with their motors' limits. The
/// time shown is the whole periods in the last 8 s, or the last 8 s without a limit cycle or with a longer period. Five views
/// show the robot from the side of its path, or from above if its joints turn about the vertical. The views are one second
/// apart at the end of the run. With a limit cycle they are a fifth of its last period apart, at most 0.8 s.
///
/// For a robot that walks (legs, contact elements, a ground) the figure also contains the central
/// spine joint (the paper's figure 14) and the footfalls of the legs. Without a limit cycle its views cover the last 2 s.
std::string run_figure(const Scenario& scenario, const Recording& record, const Summary& summary);

/// Index of the central spine joint, which is the joint marked in the paper's figure 13. The spine is all joints outside the
/// legs. Candidates are the spine joints that turn about y within 25 degrees at zero angles and therefore bend the spine up and
/// down, or all spine joints if there are none. The result is the candidate nearest, along x, to the middle between the
/// foremost and the rearmost spine joint; among equally near ones (to a millimetre) the foremost. The most loaded spine joint
/// would be unsuitable: in the hexapod it is the foremost one, beside the front legs. Nothing if all joints are in
/// legs.
std::optional<std::size_t> central_spine_joint(const RobotInfo& robot, const std::vector<Leg>& legs);

}  // namespace gaitlab::report
