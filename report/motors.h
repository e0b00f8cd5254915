// What the drives of a robot have, whichever actuator holds them.
#pragma once
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Of one joint, as its actuator answers.
struct Drive {
  double rest = 0;       ///< N m: the largest torque at rest; infinite: the actuator states no limit
  double no_load = 0;    ///< rad/s: where that torque has come to 0; infinite: it never does
  DriveRatings ratings;  ///< 0: not stated
};

/// Of every joint; empty where nothing drives joints.
std::vector<Drive> drives(const Scenario& scenario);

/// Whether the drives are DC motors, which have a voltage and a current.
bool dc_motors(const Scenario& scenario);

/// N m, of every joint: the largest torque of its motor at rest, within its limits of voltage and current (eq. 1, 2); empty
/// where the actuator is not made of DC motors.
std::vector<double> rest_torques(const Scenario& scenario);

/// Who says what the motors have: the scenario, where it gives one of their settings, else the `source` that the module type
/// gives for its actuator; empty: nobody does.
std::string motor_source(const Scenario& scenario);

/// Whether a source says that its figures are chosen, not a maker's.
bool chosen(const std::string& source);

}  // namespace gaitlab::report
