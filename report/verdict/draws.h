// Verdicts on several draws of a scenario: the same gait on robots with other tolerances and other noise of the sensors.
#pragma once
#include <atomic>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/simulation/batch.h"
#include "report/verdict/rolled.h"

namespace gaitlab::report {

/// True if the seed of a scenario changes anything: it has tolerances, or sensors that draw.
bool has_draws(const Scenario& scenario);

/// Table Recording::draws: a row for the run, then one for each of `others`, which differ from the run in their seeds. The
/// others are simulated here, without an estimate of their torque errors. Returns nothing if `stop` was set. Throws InputError
/// if a draw cannot be simulated, and PluginError.
std::optional<Trace> draws(const Scenario& scenario, const Rolled& run, std::span<const Scenario> others,
                           const BatchSettings& settings, std::atomic<bool>& stop);

/// The draws of a recording, in the order of its table. Empty if it has none.
std::vector<Draw> draws_of(const Recording& record, const Robot& robot);

/// Text `feasible in 14 of 16 robots; voltage fails in 2 (m6/active)`; empty without draws. `robots` is false if the draws
/// differ in their sensors only.
std::string draws_text(std::span<const Draw> draws, bool robots);
/// Table of the draws for the terminal, a row for each.
std::string draws_table(std::span<const Draw> draws);

}  // namespace gaitlab::report
