// Executor of the runs of a study, with threads and lanes of this process or with other processes.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/simulation/batch.h"
#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// A run to be done: its row with the values known before the run (Plan::row), its settings in the form of --set, and the
/// number of its scenario.
struct Job {
  Row row;
  std::vector<std::string> sets;
  std::size_t scenario = 0;
  bool estimate = false;  ///< true to estimate the torque error of this run, regardless of the random choice of points
  bool whole = false;     ///< true to continue this run even if it is hopeless, because its numbers are evidence
};

/// Source of an executor's jobs and receiver of their rows.
struct Work {
  /// Returns the next job, or nothing after the last one. Calls do not overlap.
  std::function<std::optional<Job>()> next;
  /// Called with the numbers of runs that begin now, side by side. Calls do not overlap.
  std::function<void(std::span<const std::uint64_t> runs)> begin;
  /// Called with the rows of runs that ended side by side, ordered by number. Several threads may call it at once.
  std::function<void(std::vector<Row>&& rows)> end;
};

/// Function that does all jobs. A repeatable failure becomes a row: a run that diverges, a scenario that is refused with its
/// values, or a plugin that throws. After `stop` is set, the function returns within one step of the current runs, which give
/// no rows. It returns false if it was stopped.
using Executor = std::function<bool(const Work& work, std::atomic<bool>& stop)>;

/// Executor that uses this process. The plan must outlive it.
Executor local_executor(const Plan& plan, const BatchSettings& settings, Measure measure);

}  // namespace gaitlab::studies
