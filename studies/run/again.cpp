#include "studies/run/again.h"

#include <algorithm>
#include <mutex>

#include "studies/journal/results.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

bool do_again(const Again& again, const Executor& executor, std::atomic<bool>& stop) {
  if (again.count == 0) return true;
  if (again.told) again.told(0, again.count);
  std::mutex mutex;
  std::size_t next = 0;
  std::size_t done = 0;
  const Work work{.next = [&]() -> std::optional<Job> {
                    if (next == again.count) return {};
                    Job job = again.job(next++);
                    job.estimate = again.estimate;
                    job.whole = true;
                    return job;
                  },
                  .begin = [](std::span<const std::uint64_t>) {},
                  .end =
                      [&](std::vector<Row>&& ended) {
                        const std::lock_guard lock(mutex);
                        done += ended.size();
                        again.take(std::move(ended));
                        if (again.told) again.told(done, again.count);
                      }};
  return executor(work, stop);
}

std::vector<std::uint64_t> runs_in_doubt(const Plan& plan, Journal& journal) {
  const std::string error = journal.column_of(kTorqueError);
  if (error.empty() || plan.study().estimate_every == 0) return {};
  const auto on = [](const StudyScenario& s) { return s.nominal.physics.estimate == Estimate::full; };
  if (std::ranges::none_of(plan.scenarios(), on)) return {};
  Estimated drawn(journal.head());
  bool without = false;  // true if a run was drawn for an estimate but has none
  std::vector<std::uint64_t> others;
  journal.each_row({"run", "point", "outcome", error}, [&](const std::vector<std::string>& row) {
    if (row[2] != name_of(Ended::done)) return;
    const bool selected = plan.estimates(row[1]);
    if (!selected && row[3].empty()) others.push_back(run_number_of(row[0]));
    drawn.others += row[3].empty() ? 1 : 0;
    if (selected && !row[3].empty()) drawn.add(number_of(row[3]));
    without = without || (selected && row[3].empty());
  });
  if (drawn.trusted() || (drawn.runs == 0 && without)) others.clear();
  return others;
}

bool estimate_again(const Plan& plan, Journal& journal, const std::vector<std::uint64_t>& runs, const Executor& executor,
                    const std::function<void(std::size_t done, std::size_t of)>& told, std::atomic<bool>& stop) {
  const Again again{.count = runs.size(),
                    .job = [&](std::size_t k) -> Job {
                      return {plan.row(runs[k]), plan.sets(runs[k]), plan.points().scenario(runs[k])};
                    },
                    .take = [&](std::vector<Row>&& rows) { journal.replace(rows); },
                    .told = told};
  return do_again(again, executor, stop);
}

}  // namespace gaitlab::studies
