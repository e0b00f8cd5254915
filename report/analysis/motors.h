// Torque, voltage and current limits of the motors at standstill, with their sources. At other speeds: envelope.h.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Whether the drives are DC motors, which have a voltage and a current.
bool dc_motors(const Scenario& scenario);

/// Number of joints with a motor of any kind.
std::size_t driven_joints(const Robot& robot);

/// Largest torque of every joint's motor at rest, within its limits of voltage and current (eq. 1, 2), N m; empty if the
/// actuator does not consist of DC motors.
std::vector<double> rest_torques(const Scenario& scenario);

/// Sources of the motor values: the `source` of the values that the scenario gives (`u_max of the scenario: data sheet 3`), and
/// the one of the module type's actuator; chosen ones first. Values without a source are chosen, and the text says so. Empty:
/// no actuator.
std::string motor_source(const Scenario& scenario);

/// Setting with which the gears create no energy (eq. 2): `take actuator.efficiency_model: directional`; empty if the actuator
/// has no such key.
std::string no_created_energy(const Scenario& scenario);

/// Whether values are chosen, not a maker's: their source contains that word, in any case, or is empty.
bool chosen(const std::string& source);

inline const std::string kNoSource = "chosen: no source stated";

/// Sources of a verdict in one sentence: `motors: maxon catalogue 118752; docks: chosen figures`. motors, docks: sources of the
/// values used by checks; empty: no check used any.
std::string figures_sentence(const std::vector<std::string>& motors, const std::vector<std::string>& docks);

}  // namespace gaitlab::report
