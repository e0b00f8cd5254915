// Warnings about a scenario before it runs: slips of units, mostly. Those about a run are checks (verdict.h).
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

/// One per cause, each with its remedy:
/// - a motor without torque: Kt, u_max or i_max is 0;
/// - a motor that makes energy: Kt and Ks, which are one constant in SI units, are more than 1.3 apart, or eta Kt > Ks;
/// - a position loop that cannot settle: sampled every Ts, an angle moves by u Ts / (Ks n) per tick, so that the error is
///   multiplied by 1 - g, g = Kp Ts / (Ks n), the share of its error that the joint goes (of a servo Ks n = V / w0). g > 2
///   diverges until the motor's limits stop it (warning), g > 1 overshoots (note). Of controllers with a gain `Kp` in V, whose
///   `Kd` does not move that bound, and DC motors;
/// - angles that only degrees would explain: beyond two turns (ranges of hinges beyond 360 turn for ever, and are meant);
/// - a robot that starts beside its heightfield.
std::vector<Warning> setup_warnings(const Scenario& scenario);

/// Whether (x, y), m, is beyond the border of the heightfield; false on other grounds.
bool beside_field(const Ground& ground, double x, double y);

}  // namespace gaitlab::report
