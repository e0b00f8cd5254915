// Texts of the estimated CPU time of runs, and the advice to take the faster engine.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/app.h"
#include "core/simulation/simulation.h"
#include "kit/run_time.h"

namespace gaitlab::app {

/// Least estimated CPU time, s, from which a run prints its estimate.
inline constexpr double kLongRun = 10;

/// Text of a time in two digits: `about 14 s`, `less than 0.1 s`.
std::string about(double seconds);

/// Text `takes about 14 s`, followed by the advice of faster_engine if there is any.
std::string time_text(double seconds, const std::string& advice = "");

/// Reads the scenarios again with further settings, as --set gives them.
using ReadAgain = std::function<std::vector<Scenario>(const std::vector<std::string>& sets)>;
/// Estimate of the CPU time of all runs of the scenarios, s.
using TimeOf = std::function<double(std::span<const Scenario> scenarios)>;

/// Advice to take engine articulated, with the estimated time and the options that select it; empty if the scenarios take less
/// than 5 s, if none of them has an engine without lanes, or if the other engine refuses one or would not be twice as fast.
std::string faster_engine(std::span<const Scenario> scenarios, double seconds, const TimeOf& time_of, const ReadAgain& again);

/// Prints on stderr, at `place`, the estimated time of all runs that `again` reads without further settings, and the advice to
/// take the faster engine. Prints nothing if the time is at most kLongRun and the advice is empty.
void note_time(const std::string& place, const TimeOf& time_of, const ReadAgain& again);

/// The advice for a run of one scenario, which `arguments` name, with a trace of this size.
std::string faster_engine(const Scenario& scenario, double seconds, const RowsNeeded& rows, const ScenarioArguments& arguments,
                          Catalog& catalog);

/// Prints on stderr the size of a trace that needs much memory.
void note_rows(const Scenario& scenario, const Simulation& simulation);

}  // namespace gaitlab::app
