// Limits of the motors at rest, with the sources of their values (envelope.h has the limits at other speeds).
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// True if the drives are DC motors, which have a voltage and a current.
bool dc_motors(const Scenario& scenario);

/// Number of joints with a motor of any kind.
std::size_t driven_joints(const Robot& robot);

/// Largest torque at rest of every joint's motor within its limits of voltage and current (eq. 1, 2), N m. Empty if the
/// actuator does not consist of DC motors.
std::vector<double> rest_torques(const Scenario& scenario);

/// Sources of the motor values, chosen ones first: of the values that the scenario gives (`u_max of the scenario: data sheet
/// 3`), and of the values of the module types. A value without a source counts as chosen, and the text says so. Empty without
/// an actuator.
std::string motor_source(const Scenario& scenario);

/// Logs of the numbers of every joint's motor; Identification::any() is false for a joint without a motor, without such logs,
/// or with a number that replaces one of the servo file, except for limits and numbers that only move currents.
std::vector<Identification> identifications(const Scenario& scenario);

/// Data of the motors that neither the scenario nor a module type states, although they are not 0 in a real motor: `by default:
/// efficiency 0.7, rotor_inertia 0`. Unlike other defaults they do not count as chosen. Empty if all are stated.
std::string silent_defaults(const Scenario& scenario);

/// Change of a setting after which the gears create no energy (eq. 2): `take actuator.efficiency_model: directional`. Empty if
/// the actuator does not have this setting.
std::string no_created_energy(const Scenario& scenario);

/// True if the source means that values were chosen and are not a maker's: it is empty or contains the word `chosen`, in upper
/// or lower case.
bool chosen(const std::string& source);

inline const std::string kNoSource = "chosen: no source stated";

/// Sentence on the sources of a verdict: `motors: maxon catalogue 118752; docks: chosen figures`. `motors` and `docks` are the
/// sources of the values that checks use, empty if no check uses any. `identified`: short texts of identifications, which
/// precede the sources of the motors; with `all`, every motor has one, and only chosen sources follow.
std::string figures_sentence(const std::vector<std::string>& motors, const std::vector<std::string>& docks,
                             const std::vector<std::string>& identified = {}, bool all = false);

}  // namespace gaitlab::report
