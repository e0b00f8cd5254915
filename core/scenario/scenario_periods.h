// The periods of a scenario: step, control, trace, CPG step and duration, which must fit into one another.
#pragma once
#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Fills in what follows from others (the control period of what nobody commands, the longest step), and adds what does not fit
/// to the problems, at the places of `root`.
void finish_periods(const Node& root, Scenario& scenario, const Catalog& catalog, Problems& problems);

}  // namespace gaitlab
