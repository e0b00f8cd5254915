// Executor of the runs of a study: threads and lanes of this process, or other processes.
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

/// A run to be done: its row with the values known beforehand (Plan::row), its settings in the form of --set, and the number of
/// its scenario.
struct Job {
  Row row;
  std::vector<std::string> sets;
  std::size_t scenario = 0;
  bool estimate = false;  ///< estimate the torque error of this run, regardless of the draw
};

/// Source of an executor's jobs and receiver of their rows.
struct Work {
  /// The next job, or nothing when all were given. One call at a time.
  std::function<std::optional<Job>()> next;
  /// Called with the runs that begin now, side by side. One call at a time.
  std::function<void(std::span<const std::uint64_t> runs)> begin;
  /// Called with the rows of runs that ended side by side, ordered by number. From several threads at once.
  std::function<void(std::vector<Row>&& rows)> end;
};

/// Does all jobs. A failure that would repeat gives a row: a run that diverges, a scenario that is refused with these values, a
/// plugin that throws. Once `stop` is set it returns within one step of the present runs, which give no rows. False: stopped.
using Executor = std::function<bool(const Work& work, std::atomic<bool>& stop)>;

/// Executor in this process. The plan must outlive it.
Executor local_executor(const Plan& plan, const BatchSettings& settings, Measure measure);

}  // namespace gaitlab::studies
