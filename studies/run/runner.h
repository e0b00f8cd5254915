// Runner of a study, which does runs by number and writes their rows to the journal.
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

/// Progress of a study, or of one of its shards.
struct Standing {
  std::uint64_t wanted = 0;  ///< number of runs of this shard
  std::uint64_t ended = 0;   ///< number of runs with a row
  std::uint64_t before = 0;  ///< number of runs that had a row at the start
  std::uint64_t kept = 0, feasible = 0, failed = 0;
  std::optional<Score> best;  ///< score of the best kept run, by the first objective
  std::uint64_t best_run = 0;
  [[nodiscard]] bool whole() const { return ended == wanted; }
  void add(const Brief& run, bool maximize);
};

struct RunnerSettings {
  Executor executor;
  Shard shard;
  int jobs = 1;  ///< number of parallel processes for runs during which the program ended before
  /// Called after each pack of runs. Calls do not overlap.
  std::function<void(const Standing&)> told = [](const Standing&) {};
  /// Called for each run with a row: first for the rows of the journal, then for each run that ends. Calls do not overlap.
  std::function<void(const Brief&)> ended = [](const Brief&) {};
};

class Runner {
 public:
  /// Counts the rows of the journal. Plan and journal must outlive this object.
  Runner(const Plan& plan, Journal& journal, RunnerSettings settings);

  /// Does the runs of this shard that have a number below `end` and no row. Each pack is written to the journal when it has
  /// ended. A run during which the process ended twice is first tried in a separate process. Returns false if `stop` was set;
  /// unfinished runs then leave no rows. Throws RunError if the journal cannot be written.
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
  std::vector<bool> present_;  ///< true if the run with this index has a row
  std::uint64_t next_ = 0;
  std::string host_ = host();
  std::mutex mutex_;                       ///< guards the following members, and the journal
  std::map<std::uint64_t, Pack> started_;  ///< packs by their first run
  Standing standing_;
};

}  // namespace gaitlab::studies
