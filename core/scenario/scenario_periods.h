// The periods of a scenario: step, control, trace, CPG step and duration, which must fit into one another.
#pragma once
#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Sets periods that follow from others (the control period without actuator and CPG, the longest step), and adds periods that
/// do not fit to the problems, at the places of `root`.
void finish_periods(const Node& root, Scenario& scenario, const Catalog& catalog, Problems& problems);

/// Adds a problem for each period that is not a whole multiple of the step.
void check_step(const Node& root, const Scenario& scenario, Problems& problems);

}  // namespace gaitlab
