// What the motors of a robot have, whichever actuator holds them.
#pragma once
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// N m, of every joint: the largest torque of its motor at rest, within its limits of voltage and current (eq. 1, 2); empty
/// where the actuator is not made of DC motors.
std::vector<double> rest_torques(const Scenario& scenario);

/// Whether every joint's actuator states a largest command, and so a limit that can be reached.
bool limited(const Scenario& scenario);

}  // namespace gaitlab::report
