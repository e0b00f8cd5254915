// What to tell the user about a step that is too long.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// The largest step of the series 1, 1.25, 2, 2.5, 5 times a power of ten that is at most `limit` and divides the control
/// period, the trace period and the duration; 0 if none above 1e-9 s does.
double usable_step(const Scenario& scenario, double limit);

/// `the motor of joint m0/active`, `the hinge stop of ...`, `the contact m3/passive/p0`.
std::string source_of(const Stability& stability, const Robot& robot, const std::vector<ContactElement>& contacts);

/// One sentence: the step, the largest allowed one and what sets it, and a step to use. `when`: "standing", "at t = 3.1 s".
std::string step_advice(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Stability& stability,
                        const std::string& when);

}  // namespace gaitlab
