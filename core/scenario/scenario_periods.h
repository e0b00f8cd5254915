// Periods of a scenario (step, control, trace, CPG step, duration), some of which must be multiples of others.
#pragma once
#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Sets periods that depend on other periods: the control period of a robot without actuator and CPG, and the longest step.
/// Adds a problem at the places of `root` for each period that is not a multiple of the required one.
void finish_periods(const Node& root, Scenario& scenario, const Catalog& catalog, Problems& problems);

/// Adds a problem for each period that is not a whole multiple of the step.
void check_step(const Node& root, const Scenario& scenario, Problems& problems);

}  // namespace gaitlab
