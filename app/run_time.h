// Estimate of the CPU time of a run, from a table of costs. It reads no clock, so that a scenario has the same estimate in
// every call, and no result depends on it.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/app.h"
#include "core/simulation/simulation.h"

namespace gaitlab::app {

/// Least estimated CPU time, s, from which a run prints its estimate.
inline constexpr double kLongRun = 10;

/// CPU time of a run, s, to within a factor of two on one core of the machine of docs/benchmarks.md; 0 if the table lacks the
/// engine. An integrator that chooses its steps is tried for at most a hundred control periods, with at most 10 ms of work,
/// because the number of its steps depends on the gait. `rows` is the size of the trace.
double estimated_seconds(const Scenario& scenario, const RowsNeeded& rows = {});

/// The same for a run of a study, which writes no files. Its lanes save as much as ticks and statistics of each lane cost.
double estimated_seconds_in_study(const Scenario& scenario);

/// Takes the first steps of a simulation, at most a hundred control periods and about 4 ms of work. Returns the message of the
/// error that ends the run in them; empty if none does.
std::string early_failure(Simulation& simulation, const Scenario& scenario);

/// Text of a time in two digits: `about 14 s`, `less than 0.1 s`.
std::string about(double seconds);

/// Text `takes about 14 s`, and the advice of faster_engine behind it if there is one.
std::string time_text(double seconds, const std::string& advice = "");

/// Reads the scenarios again with further settings, as --set gives them.
using ReadAgain = std::function<std::vector<Scenario>(const std::vector<std::string>& sets)>;
/// Estimate of the CPU time of all runs of the scenarios, s.
using TimeOf = std::function<double(std::span<const Scenario> scenarios)>;

/// Advice to take engine articulated, with the estimated time and the options that select it; empty if the scenarios take less
/// than 5 s, if none of them has an explicit engine, or if the other engine refuses one or would not be twice as fast.
std::string faster_engine(std::span<const Scenario> scenarios, double seconds, const TimeOf& time_of, const ReadAgain& again);

/// Prints on stderr, at `place`, the estimated time of all runs that `again` reads without further settings, if it is above
/// kLongRun, and the advice to take the faster engine.
void note_time(const std::string& place, const TimeOf& time_of, const ReadAgain& again);

/// The advice for a run of one scenario, which `arguments` name, with a trace of this size.
std::string faster_engine(const Scenario& scenario, double seconds, const RowsNeeded& rows, const ScenarioArguments& arguments,
                          Catalog& catalog);

}  // namespace gaitlab::app
