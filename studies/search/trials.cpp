#include "studies/search/trials.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "studies/run/again.h"

namespace gaitlab::studies {

bool run_trials(const Plan& plan, std::vector<Trial>& trials, bool estimate, const Executor& executor, const TrialsTold& told,
                std::atomic<bool>& stop) {
  std::vector<Job> jobs;
  std::vector<std::pair<std::size_t, std::size_t>> of;  // trial and row of each job
  for (std::size_t t = 0; t < trials.size(); ++t) {
    Trial& trial = trials[t];
    for (std::uint64_t run = trial.point.first_run; run < trial.point.first_run + trial.point.runs; ++run) {
      if (trial.first_replicates && plan.points().replicate(run) > 0) continue;
      Job job{plan.row(run), plan.sets(run), plan.points().scenario(run)};
      job.row.run = jobs.size();
      std::ranges::copy(trial.sets(run), std::back_inserter(job.sets));
      jobs.push_back(std::move(job));
      of.emplace_back(t, trial.rows.size());
      trial.rows.emplace_back();
    }
  }
  const auto take = [&](std::vector<Row>&& ended) {
    for (Row& row : ended) trials[of[row.run].first].rows[of[row.run].second] = std::move(row);
  };
  const Again again{
      .count = jobs.size(), .job = [&](std::size_t k) { return jobs[k]; }, .take = take, .told = told, .estimate = estimate};
  return do_again(again, executor, stop);
}

PointResult result_of(const Journal& journal, const Trial& trial) {
  std::vector<Brief> briefs;
  for (std::size_t r = 0; r < trial.rows.size(); ++r) {
    const Row& row = trial.rows[r];
    briefs.push_back({trial.point.first_run + r, row.outcome, row.message, row.simulated, row.score, row.verdict});
  }
  return point_result(journal.head(), briefs);
}

Verification without_reason(const Plan& plan, const Journal& journal, const Trial& trial) {
  const PointResult is = result_of(journal, trial);
  Verification v{trial.point.first_run, trial.kind, trial.name, {}, is.score.violation, trial.rows.front().verdict, ""};
  for (const Row& row : trial.rows) {
    if (row.verdict == Word::infeasible) v.verdict = row.verdict;
  }
  for (std::size_t k = 0; k < plan.study().objectives.size(); ++k)
    v.objectives.push_back(is.failed > 0 ? std::nan("") : is.score.objectives[k]);
  return v;
}

bool speaks_against(Word verdict, double evidence) {
  return verdict == Word::infeasible || (verdict == Word::not_judged && evidence < 0);
}

double quantity(const Plan& plan, const Row& row, const std::string& name) {
  const auto at = std::ranges::find(plan.columns(), name, &Quantity::name);
  return at == plan.columns().end() ? std::nan("") : row.quantities.at(static_cast<std::size_t>(at - plan.columns().begin()));
}

double evidence(const Plan& plan, const Row& row) { return quantity(plan, row, kEvidence); }

std::string in_scenario(const Row& row) { return row.scenario.empty() ? "" : "in " + row.scenario + ": "; }

}  // namespace gaitlab::studies
