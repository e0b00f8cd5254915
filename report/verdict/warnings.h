// Warnings about a scenario before it runs: mostly wrong units. Warnings about a run are checks (verdict.h).
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

struct Warning {
  SourceLocation place;
  std::string text;
  bool severe = true;  ///< false: a note
};

/// Warnings of a scenario, one per cause, each with its remedy: - a motor without torque: Kt, u_max or i_max is 0; - a motor
/// that creates energy: Kt and Ks, which are one constant in SI units, differ by more than a factor of 1.3, or eta Kt > Ks; - a
/// position loop that cannot settle: sampled every Ts, an angle moves by u Ts / (Ks n) per tick, so that the error is
/// multiplied by 1 - g, g = Kp Ts / (Ks n), the share of the error that the joint moves per tick (for a servo Ks n = V / w0). g
/// > 2 diverges until the motor's limits stop it (warning), g > 1 overshoots (note). For controllers with a gain `Kp` in V,
/// whose `Kd` does not change that bound, and DC motors; - angles that only degrees would explain: beyond two turns (a range
/// beyond 360 means an unlimited hinge, and is intended); - a robot that starts beside its heightfield.
std::vector<Warning> setup_warnings(const Scenario& scenario);

}  // namespace gaitlab::report
