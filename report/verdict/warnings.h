// Warnings about a scenario before it runs, most of which detect wrong units. Warnings about a run are checks (verdict.h).
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Largest Kt / Ks or Ks / Kt without a warning. The two are one constant in SI units, and measured ones of one motor agree to
/// 10 %.
inline constexpr double kConstantsApart = 1.3;

struct Warning {
  SourceLocation place;
  std::string text;
  bool severe = true;    ///< false: a note
  bool of_gait = false;  ///< the warning is on the scenario's own gait, which a study varies
};

/// Warnings about a scenario, each with its cause and remedy:
/// - A motor without torque: Kt, u_max or i_max is 0.
/// - A motor that creates energy (eta Kt > Ks), or whose Kt and Ks differ by more than a factor of 1.3, although they are one
/// constant in SI units.
/// - A position loop that cannot settle. A command u held for Ts turns the joint by u Ts / (Ks n), with n the gear ratio. The
/// error is therefore multiplied by 1 - g per tick, with g = Kp Ts / (Ks n); for a servo, Ks n = V / w0. g > 2 diverges until
/// the motor's limits stop it (warning); g > 1 overshoots (note). Only for DC motors and controllers with a gain `Kp` in V
/// whose `Kd` does not change that bound.
/// - A number outside its usual range (plausibility.h), with the unit in which it may have been given. Without a position loop
/// that cannot settle if the control period or the speed of a motor is such a number.
/// - Bodies of one module that overlap by design (note).
/// - A robot that starts beside its heightfield.
///
/// Refuses rows of Scenario::accept without an unusual number (InputError).
std::vector<Warning> setup_warnings(const Scenario& scenario);

}  // namespace gaitlab::report
