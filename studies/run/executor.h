// What does the runs of a study: threads and lanes of this process, or other processes.
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

/// A run to be done: its row as far as that is known before (Plan::row), its settings, as for --set, and the number of the
/// scenario that they are of.
struct Job {
  Row row;
  std::vector<std::string> sets;
  std::size_t scenario = 0;
  bool estimate = false;  ///< the torque error of this one, whatever is drawn
};

/// Where an executor takes jobs from, and gives their rows to.
struct Work {
  /// The next job, or nothing when all were given. One call at a time.
  std::function<std::optional<Job>()> next;
  /// Those that begin now, side by side. One call at a time.
  std::function<void(std::span<const std::uint64_t> runs)> begin;
  /// Rows of those that ended side by side, in the order of their numbers. From several threads at once.
  std::function<void(std::vector<Row>&& rows)> end;
};

/// Does all jobs. What would happen again is a row: a run that diverges, one whose scenario is refused with these values, a
/// plugin that throws. Once `stop` is set it returns within a step of what runs, of which no rows are given. False: stopped.
using Executor = std::function<bool(const Work& work, std::atomic<bool>& stop)>;

/// In this process. The plan must outlive it.
Executor local_executor(const Plan& plan, const BatchSettings& settings, Measure measure);

}  // namespace gaitlab::studies
