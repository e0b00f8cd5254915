// Settings that select another engine for a scenario.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Settings (KEY=VALUE) that select another engine with one of its integrators and a step (a number in s, or `auto`). Gravity
/// and estimate do not change. `accuracy` is kept if the integrator chooses its steps, because other integrators refuse this
/// key.
std::vector<std::string> engine_settings(const Scenario& scenario, const std::string& engine, const Integrator& integrator,
                                         const std::string& step);

}  // namespace gaitlab
