// Estimate of the CPU time of a run, from a table of costs. It reads no clock, so that a scenario has the same estimate in
// every call, and no result depends on it.
#pragma once
#include <string>

#include "core/scenario/scenario.h"
#include "core/simulation/simulation.h"

namespace gaitlab::kit {

/// CPU time of a run, s, to within a factor of two on one core of the machine of docs/benchmarks.md; 0 if the table lacks the
/// engine. An integrator that chooses its steps is tried for at most a hundred control periods, with about 30 ms of work,
/// because the number of its steps depends on the gait. `rows` is the size of the trace.
double estimated_seconds(const Scenario& scenario, const RowsNeeded& rows = {});

/// The same for a run of a study, which writes no files. Lanes are not counted: they save as much as the ticks and statistics
/// of each lane cost.
double estimated_seconds_in_study(const Scenario& scenario);

/// Takes the first steps of a simulation, at most a hundred control periods and about 4 ms of work. Returns the message of the
/// error that ends the run within these steps, or an empty text.
std::string early_failure(Simulation& simulation, const Scenario& scenario);

}  // namespace gaitlab::kit
