// What the motors of a robot have at rest, and who says so. At every speed: envelope.h.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Whether the drives are DC motors, which have a voltage and a current.
bool dc_motors(const Scenario& scenario);

/// How many joints have a motor, whatever drives it.
std::size_t driven_joints(const Robot& robot);

/// N m, of every joint: the largest torque of its motor at rest, within its limits of voltage and current (eq. 1, 2); empty
/// where the actuator is not made of DC motors.
std::vector<double> rest_torques(const Scenario& scenario);

/// Who says what the motors have: the `source` that the module type gives for its actuator, behind the settings that the
/// scenario gives instead (`i_max of the scenario; the rest: chosen ...`); empty: nobody does.
std::string motor_source(const Scenario& scenario);

/// What would keep the gears from creating energy (eq. 2): `actuator.efficiency_model: directional does not`; empty where the
/// actuator has no such key.
std::string no_created_energy(const Scenario& scenario);

/// Whether a source says of any of its figures that it is chosen, not a maker's: it has that word.
bool chosen(const std::string& source);

}  // namespace gaitlab::report
