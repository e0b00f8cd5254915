// The list of all checks of the verdict.
#pragma once
#include <vector>

#include "report/verdict/check.h"

namespace gaitlab::report::checks {

// Rows of the list, by file: of the check with the name of the file, or of a family of checks.
std::vector<CheckKind> outcome(), fall(), progress(), upright(), battery();
std::vector<CheckKind> saturation(), envelope(), speed(), stall(), heat(), gears();
std::vector<CheckKind> tracking(), stops(), setpoints(), collision(), docks();
std::vector<CheckKind> in_ground(), slip(), airborne(), stability(), field();
std::vector<CheckKind> periodic(), evidence(), torque_error(), predictable(), creep(), energy(), steps(), measured(),
    identified();

/// The order of the verdict: by group.
inline constexpr std::vector<CheckKind> (*kList[])() = {
    outcome, fall,     progress, upright,      battery,     saturation, envelope,  speed, stall,    heat,
    gears,   tracking, stops,    setpoints,    collision,   docks,      in_ground, slip,  airborne, stability,
    field,   periodic, evidence, torque_error, predictable, creep,      energy,    steps, measured, identified};

}  // namespace gaitlab::report::checks
