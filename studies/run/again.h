// Second simulations of a study's runs, usually with an estimate of the torque error.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "studies/run/executor.h"

namespace gaitlab::studies {

/// Second runs with the numbers 0 to count - 1, which continue even if they are hopeless. `told` is called before the first run
/// with 0 and `count`. When a group of runs that were simulated together has ended, `take` is called with their rows, and then
/// `told` with the number of all runs that have ended so far, and `count`. Calls do not overlap.
struct Again {
  std::size_t count = 0;
  std::function<Job(std::size_t number)> job;
  std::function<void(std::vector<Row>&& rows)> take;
  std::function<void(std::size_t done, std::size_t of)> told = {};
  bool estimate = true;  ///< false: only runs of points that are drawn for an estimate have one
};
bool do_again(const Again& again, const Executor& executor, std::atomic<bool>& stop);

/// Runs that need a second run with an estimate. The list contains all runs without an estimate if too few estimates exist, or
/// if more than one estimate in ten is inaccurate (Estimated::trusted). Otherwise the list is empty. The list is empty also if
/// the study or its scenarios disable the estimate.
std::vector<std::uint64_t> runs_in_doubt(const Plan& plan, Journal& journal);

/// Simulates these runs again, with an estimate of their torque errors, and replaces their rows in the journal. Returns false
/// if `stop` was set.
bool estimate_again(const Plan& plan, Journal& journal, const std::vector<std::uint64_t>& runs, const Executor& executor,
                    const std::function<void(std::size_t done, std::size_t of)>& told, std::atomic<bool>& stop);

}  // namespace gaitlab::studies
