// Does runs of a study: from their numbers to rows in its journal.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "studies/journal/study_folder.h"
#include "studies/run/executor.h"

namespace gaitlab::studies {

/// How far a study is.
struct Standing {
  std::uint64_t wanted = 0;  ///< of this shard
  std::uint64_t ended = 0;   ///< have a row
  std::uint64_t before = 0;  ///< of these, had one when it began
  std::uint64_t kept = 0, feasible = 0, failed = 0;
  std::optional<Score> best;  ///< of kept runs, by the first objective
  std::uint64_t best_run = 0;
  [[nodiscard]] bool whole() const { return ended == wanted; }
  void add(const Brief& run, bool maximize);
};

struct RunnerSettings {
  Executor executor;
  Shard shard;
  int jobs = 1;  ///< processes for runs during which the program ended before
  /// After each pack, one call at a time.
  std::function<void(const Standing&)> told = [](const Standing&) {};
  /// Of each run that has a row: those of the journal first, then each as it ends. One call at a time.
  std::function<void(const Brief&)> ended = [](const Brief&) {};
};

class Runner {
 public:
  /// Plan and journal must outlive it; the journal's rows are counted.
  Runner(const Plan& plan, Journal& journal, RunnerSettings settings);

  /// Does the runs of this shard, numbered below `end`, that have no row. Each pack is in the journal when it has ended. A run
  /// during which the process ended twice gets a process of its own first. False: `stop` was set; what ran leaves no rows.
  /// RunError: the journal cannot be written.
  bool run(std::uint64_t end, std::atomic<bool>& stop);

  [[nodiscard]] const Standing& standing() const { return standing_; }

 private:
  struct Pack {
    std::chrono::steady_clock::time_point since;
    std::string utc;
    std::vector<std::uint64_t> runs;
  };

  void run_suspects(std::uint64_t end, const std::atomic<bool>& stop);
  std::optional<Job> next(std::uint64_t end);
  void begin(std::span<const std::uint64_t> runs);
  void write(const std::vector<Row>& rows);
  void forget_stopped();

  const Plan& plan_;
  Journal& journal_;
  RunnerSettings settings_;
  bool maximize_;
  std::vector<bool> present_;  ///< by run
  std::uint64_t next_ = 0;
  std::string host_ = host();
  std::mutex mutex_;                       ///< of what follows, and of the journal
  std::map<std::uint64_t, Pack> started_;  ///< by their first run
  Standing standing_;
};

}  // namespace gaitlab::studies
