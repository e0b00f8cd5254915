// Settings that give a scenario another engine.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Settings (KEY=VALUE) for another engine with one of its integrators and a step (a number in s, or auto). Gravity and
/// estimate stay. An accuracy stays if that integrator has one; others refuse it.
std::vector<std::string> engine_settings(const Scenario& scenario, const std::string& engine, const Integrator& integrator,
                                         const std::string& step);

}  // namespace gaitlab
