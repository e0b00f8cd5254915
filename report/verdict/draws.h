// Verdicts on several draws of a scenario: the same gait on robots with other tolerances and other noise of the sensors.
#pragma once
#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/simulation/batch.h"
#include "report/verdict/rolled.h"

namespace gaitlab::report {

/// Draws that were simulated.
struct Drawn {
  Trace table;  ///< Recording::draws: a row for the run, then one for each draw that ended
  /// Draws that could not begin, such as `seed 7: ...`. Their rows have the word `failed`.
  std::vector<std::string> refused;
};

/// Simulates and judges `others`, which differ from the run in their seeds. If the torque error of the run is below a fifth of
/// its limit and its motion is predictable, the others run in lanes without an estimate of their errors; otherwise each
/// estimates its own. Once `stop` is set, the table has the draws that have ended. `ended` is called after each draw, from
/// several threads at once. Throws PluginError.
Drawn draws(const Scenario& scenario, const Rolled& run, std::span<const Scenario> others, const BatchSettings& settings,
            std::atomic<bool>& stop, const std::function<void()>& ended = {});

/// The draws of a recording, in the order of its table. Empty if it has none.
std::vector<Draw> draws_of(const Recording& record, const Scenario& scenario);

/// Text `feasible in 14 of 16 robots; voltage fails in 2 (m6/active)`; empty without draws. `robots` is false if the draws
/// differ in their sensors only.
std::string draws_text(std::span<const Draw> draws, bool robots);
/// Table of the draws for the terminal. If there are more than `most` draws, it lists only draws that are not feasible, at most
/// `most`.
std::string draws_table(std::span<const Draw> draws, std::size_t most);

}  // namespace gaitlab::report
