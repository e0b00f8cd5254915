// Instability of a controller, whose commands throw the robot about.
#pragma once
#include <string>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Sentence on an unstable controller, such as `the controller is unstable from 0.03 s on (Kp 1e+04 V/rad, Kd 0.6 V s/rad, a
/// command every 0.015 s): ...`. Empty for a stable controller. A controller is unstable if, up to the end of the run, the
/// command of a joint changes its sign in most control ticks (JointStatistics::reversals). In addition, in this time and not
/// before, this joint is more than 1 rad beyond its range, or the base is faster than 10 m/s and than twice the speed of a fall
/// from its largest height.
std::string instability(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
