// Advice to the user about a step that is too long.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Largest usable step of the series 1, 1.25, 2, 2.5, 5 times a power of ten. A usable step is at most `limit` and divides the
/// control period, the trace period and the duration. Returns 0 if no step from 1e-8 s up is usable.
double usable_step(const Scenario& scenario, double limit);

/// Step for an engine with a stability limit: the largest usable step up to `longest` with h lambda of at most 0.8 for the
/// standing robot. The reserve is for the gait, whose h lambda may rise up to 1. If contacts set lambda, h lambda is at most
/// 0.45, because a gait that puts the weight on half of the feet doubles the friction of each foot. Returns 0 if no step above
/// a hundredth of the stability limit divides the periods. Throws the errors of the constructor of Simulation.
double stable_step(const Scenario& scenario, double longest);

/// Text with the source of the rate: "the motor of joint m0/active", "the hinge stop of joint m0/active", "the contact
/// m3/passive/p0".
std::string source_of(const Stability& stability, const Robot& robot, const std::vector<ContactElement>& contacts);

/// Sentence with the step, the largest allowed step and the source of this limit, and a usable step. `when` is "standing" or
/// "at t = 3.1 s".
std::string step_advice(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Stability& stability,
                        const std::string& when);

}  // namespace gaitlab
