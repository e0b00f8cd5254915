#include "studies/run/executor.h"

#include <map>
#include <mutex>

namespace gaitlab::studies {

namespace {

/// The jobs of one call of the executor, from next() to end().
class LocalWork {
 public:
  LocalWork(const Plan& plan, const Measure& measure, const Work& work) : plan_(plan), measure_(measure), work_(work) {}

  bool run(const BatchSettings& settings, std::atomic<bool>& stop) {
    BatchStream stream{.next = [&] { return stop ? std::nullopt : next(); },
                       .begin = [this](std::span<const Rollout> pack) { begin(pack); },
                       .end = [this](std::vector<RolloutEnd>&& pack) { end(std::move(pack)); }};
    if (!plan_.stops().empty()) {
      stream.watch = [this](const Rollout& rollout, const Recording& so_far) {
        return plan_.stops().reason(rollout.scenario, so_far, whole(rollout.number));
      };
    }
    const bool whole = run_pulled(stream, settings, measure_.reads, stop);
    if (whole) give_refused();
    return whole;
  }

 private:
  std::optional<Rollout> next() {
    while (std::optional<Job> job = work_.next()) {
      const std::uint64_t run = job->row.run;
      try {
        Rollout rollout{run, plan_.with(job->sets, job->scenario)};
        Physics& physics = rollout.scenario.physics;
        if (physics.estimate == Estimate::full && !job->estimate && !plan_.estimates(job->row.point)) {
          physics.estimate = Estimate::off;
          physics.estimated_by_others = true;
        }
        const std::lock_guard lock(mutex_);
        jobs_[run] = std::move(*job);
        return rollout;
      } catch (const InputError& error) {
        refuse(job->row, error.problems());
        refused_.push_back(std::move(job->row));
        constexpr std::size_t kMany = 64;
        if (refused_.size() >= kMany) give_refused();
      }
    }
    return {};
  }

  void begin(std::span<const Rollout> pack) {
    std::vector<std::uint64_t> runs;
    for (const Rollout& one : pack) runs.push_back(one.number);
    work_.begin(runs);
  }

  void end(std::vector<RolloutEnd>&& pack) {
    std::vector<Row> rows;
    for (RolloutEnd& one : pack) {
      Row row = take(one.rollout.number);
      if (one.refused.empty()) {
        plan_.finish(row, one.rollout.scenario, one.recording, measure_);
      } else {
        refuse(row, one.refused);
      }
      rows.push_back(std::move(row));
    }
    work_.end(std::move(rows));
  }

  Row take(std::uint64_t run) {
    const std::lock_guard lock(mutex_);
    return std::move(jobs_.extract(run).mapped().row);
  }

  bool whole(std::uint64_t run) {
    const std::lock_guard lock(mutex_);
    return jobs_.at(run).whole;
  }

  /// Marks the row of a run whose scenario is refused with its values. The message is the first problem.
  static void refuse(Row& row, const std::vector<Problem>& problems) {
    row.outcome = "refused";
    row.message = problems.empty() ? "" : problems.front().text;
    row.verdict = Word::failed;
  }

  void give_refused() {
    if (!refused_.empty()) work_.end(std::exchange(refused_, {}));
  }

  const Plan& plan_;
  const Measure& measure_;
  const Work& work_;
  std::vector<Row> refused_;  ///< rows refused by next(), which only one thread at a time calls
  std::mutex mutex_;          ///< guards the following members
  std::map<std::uint64_t, Job> jobs_;
};

}  // namespace

Executor local_executor(const Plan& plan, const BatchSettings& settings, Measure measure) {
  return [&plan, settings, measure = std::move(measure)](const Work& work, std::atomic<bool>& stop) {
    return LocalWork(plan, measure, work).run(settings, stop);
  };
}

}  // namespace gaitlab::studies
