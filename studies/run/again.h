// Second runs of a study's runs, with an estimate of the torque error.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "studies/run/executor.h"

namespace gaitlab::studies {

/// Jobs 0 to count - 1. `take(rows)`: called with rows that ended side by side; `told(done, count)`: called after it. One call
/// at a time. False: `stop` was set.
struct Again {
  std::size_t count = 0;
  std::function<Job(std::size_t number)> job;
  std::function<void(std::vector<Row>&& rows)> take;
  std::function<void(std::size_t done, std::size_t of)> told = {};
};
bool do_again(const Again& again, const Executor& executor, std::atomic<bool>& stop);

/// Runs without an estimate, if too few have one, or more than one in ten of these is inaccurate (Estimated::trusted);
/// else none. None if study or scenario turn the estimate off.
std::vector<std::uint64_t> runs_in_doubt(const Plan& plan, Journal& journal);

/// Runs these again with an estimate and replaces their rows in the journal.
bool estimate_again(const Plan& plan, Journal& journal, const std::vector<std::uint64_t>& runs, const Executor& executor,
                    const std::function<void(std::size_t done, std::size_t of)>& told, std::atomic<bool>& stop);

}  // namespace gaitlab::studies
