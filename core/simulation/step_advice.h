// Advice to the user about a step that is too long.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Largest step of the series 1, 1.25, 2, 2.5, 5 times a power of ten that is at most `limit` and divides the control period,
/// the trace period and the duration; 0 if no step from 1e-8 s up does.
double usable_step(const Scenario& scenario, double limit);

/// Step for an engine whose stability limits it: the largest usable one up to `longest` at which h lambda of the standing robot
/// is at most 0.8, so that a gait may raise it to 1; at most 0.45 if contacts set lambda, because a gait that puts the weight
/// on half of the feet doubles the friction of each. 0: no step above a hundredth of that limit divides the periods. Throws
/// what Simulation throws.
double stable_step(const Scenario& scenario, double longest);

/// `the motor of joint m0/active`, `the hinge stop of ...`, `the contact m3/passive/p0`.
std::string source_of(const Stability& stability, const Robot& robot, const std::vector<ContactElement>& contacts);

/// One sentence with the step, the largest allowed step and what sets it, and a usable step. `when`: "standing", "at t = 3.1
/// s".
std::string step_advice(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Stability& stability,
                        const std::string& when);

}  // namespace gaitlab
