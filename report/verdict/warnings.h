// Warnings about a scenario before it runs, most of which detect wrong units. Warnings about a run are checks (verdict.h).
#pragma once
#include <vector>

#include "report/verdict/plausible/plausible_number.h"

namespace gaitlab::report {

/// Warnings about a scenario, each with its cause and remedy:
/// - A motor without torque: Kt, u_max or i_max is 0.
/// - A motor that creates energy (eta Kt > Ks), or whose Kt and Ks differ by more than a factor of 1.3, although they are one
/// constant in SI units.
/// - A position loop (position_loop.h) with a gain above its bound, which may not settle (warning), or above half of it, which
/// overshoots (note). The message has the largest Kp and the longest control period.
/// - An encoder whose step commands more than 10 % of the motor's torque at rest.
/// - Legs that yield under the robot's weight (leg_sag.h).
/// - A number outside its usual range (plausibility.h), with the unit in which it may have been given. If the control period, a
///   gain or the speed of a motor is such a number, position loops and encoders are not judged.
/// - Bodies of one module that overlap by design (note).
/// - A robot that starts beside its heightfield.
///
/// Refuses rows of Scenario::accept without an unusual number (InputError).
std::vector<Warning> setup_warnings(const Scenario& scenario);

}  // namespace gaitlab::report
