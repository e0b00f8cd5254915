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

/// Who says what the motors have: the `source` of the figures that the scenario gives (`u_max of the scenario: data sheet 3`),
/// and the one that the module type gives for its actuator; those that are chosen first. Figures without a source are chosen,
/// and the text says so. Empty: no actuator.
std::string motor_source(const Scenario& scenario);

/// What would keep the gears from creating energy (eq. 2): `take actuator.efficiency_model: directional`; empty where the
/// actuator has no such key.
std::string no_created_energy(const Scenario& scenario);

/// Whether figures are chosen, not a maker's: their source has that word, in any case, or there is none.
bool chosen(const std::string& source);

inline const std::string kNoSource = "chosen: no source stated";

/// What a verdict rests on, in one sentence: `motors: maxon catalogue 118752; docks: chosen figures`. motors, docks: the
/// sources of the figures that checks were judged by; none: none was.
std::string figures_sentence(const std::vector<std::string>& motors, const std::vector<std::string>& docks);

}  // namespace gaitlab::report
