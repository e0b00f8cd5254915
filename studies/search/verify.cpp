#include "studies/search/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "studies/search/step_limit.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

/// Setting that divides the step or, if the integrator chooses its steps, the accuracy.
std::string divided(const Physics& physics, double by) {
  if (physics.adaptive_step) return "physics.accuracy=" + number_text(physics.accuracy / by);
  return "physics.step=" + number_text(physics.step / by);
}

std::vector<std::string> halved(const Plan& plan, std::uint64_t run) { return {divided(plan.scenario(run).physics, 2)}; }

/// Settings of the other engine with a quarter of its step.
std::vector<std::string> quartered(const Plan& plan, std::uint64_t run) {
  std::vector<std::string> sets = plan.sets(run);
  std::vector<std::string> other = plan.other_engine(run);
  if (other.empty()) return other;
  std::ranges::copy(other, std::back_inserter(sets));
  other.push_back(divided(plan.with(sets, plan.points().scenario(run)).physics, 4));
  return other;
}

/// Trials that run a point again as the study defines.
std::vector<Trial> ways(const Plan& plan, const PointResult& point) {
  std::vector<Trial> ways;
  const Verify& verify = plan.study().verify;
  if (verify.halve_step)
    ways.push_back({point, TrialKind::half_step, "", [&plan](std::uint64_t run) { return halved(plan, run); }});
  if (plan.bound().has_other_engine()) {
    ways.push_back({point, TrialKind::other_engine, clipped(verify.engine),
                    [&plan](std::uint64_t run) { return plan.other_engine(run); }});
  }
  return ways;
}

/// Reason why a verdict rejects a point, even if the check is not a guard; "" without a reason. `why` is the sentence after the
/// word.
std::string doubt(Word word, double evidence, const std::string& why) {
  const std::string end = why.empty() ? "" : ": " + why;
  if (!speaks_against(word, evidence)) return "";
  return (word == Word::infeasible ? "the verdict is infeasible" : name_of(word)) + end;
}

/// True if the verdict on a single run counts. Runs in worlds only count together in a robust study.
bool counts_alone(const Plan& plan, std::uint64_t replicate) { return !plan.study().robust || replicate == 0; }

/// A reason made of several texts.
struct Reason {
  std::string text;
  void add(const std::string& one) { text += (text.empty() ? "" : "; ") + one; }
};

/// Objectives that differ too much from those of `was`; "" if there are none.
std::string changes(const Plan& plan, const Score& was, const Score& is) {
  Reason why;
  for (std::size_t k = 0; k < plan.study().objectives.size(); ++k) {
    const double then = was.objectives[k];
    const double now = is.objectives[k];
    if (std::abs(now - then) <= plan.study().verify.change * std::abs(then)) continue;
    why.add(fmt::format("{} is {:.4g} instead of {:.4g}, beyond the {:.3g} % of verify.change",
                        clipped(plan.scorer().objectives()[k]), now, then, 100 * plan.study().verify.change));
  }
  return why.text;
}

/// The failure of a run; "" if all runs ended normally.
std::string failure(const Plan& plan, const Trial& trial, const PointResult& is) {
  for (const Row& row : trial.rows) {
    const bool tolerated = plan.study().robust && is.failed == 0 && row.replicate > 0;
    if (row.outcome != "done" && !tolerated) return in_scenario(row) + row.outcome + ": " + row.message;
  }
  return "";
}

bool had_long_steps(const Plan& plan, const Row& row) {
  return row.outcome == "diverged" || quantity(plan, row, "margin.step") < 0;
}

/// Limits that the runs break, and doubts of their verdicts; "" if there are none. Only the first failing replicate is
/// described.
std::string broken_limits(const Plan& plan, const Trial& trial, const PointResult& is) {
  for (const Row& row : trial.rows) {
    if (row.outcome != "done") continue;
    const bool breaks = is.score.violation > 0 && row.score && row.score->violation > 0;
    const std::string doubted = counts_alone(plan, row.replicate) ? doubt(row.verdict, evidence(plan, row), row.message) : "";
    if (!breaks && doubted.empty()) continue;
    Reason why;
    const std::vector<std::string> broken = plan.scorer().broken(row.quantities, row.verdict, row.message);
    const std::string of_verdict = name_of(row.verdict) + (row.message.empty() ? std::string() : ": " + row.message);
    if (breaks) why.add(in_scenario(row) + fmt::format("{}", fmt::join(broken, ", ")));
    const bool said = breaks && std::ranges::find(broken, of_verdict) != broken.end();
    if (!doubted.empty() && !said) why.add(in_scenario(row) + doubted);
    if (had_long_steps(plan, row))
      why.add("the step of this run was too long at times (check step), so that a shorter step may verify the point");
    return why.text;
  }
  return "";
}

/// Entry for the original runs of a point.
Verification as_run(const Plan& plan, Journal& journal, const PointResult& point) {
  Verification own{point.first_run, TrialKind::as_run, "", {}, point.score.violation, Word::failed, ""};
  const std::vector<std::string> names = journal.columns().all();
  const auto place = [&](const std::string& name) { return place_in(names, name); };
  for (std::uint64_t run = point.first_run; run < point.first_run + point.runs; ++run) {
    const std::vector<std::string> row = journal.row(run);
    const Word word = named_cell<Word>(row[place("verdict")], "verdict", journal.file());
    if (run == point.first_run) own.verdict = word;
    if (!counts_alone(plan, plan.points().replicate(run))) continue;
    const std::string doubted = doubt(word, number_of(row[place(kEvidence)]), row[place("message")]);
    if (doubted.empty() || !own.reason.empty()) continue;
    own.verdict = word;
    own.reason = in_scenario(plan.row(run)) + doubted;
  }
  for (std::size_t k = 0; k < plan.study().objectives.size(); ++k) own.objectives.push_back(point.score.objectives[k]);
  return own;
}

/// Order of the integrator, if it is equal in all runs of a point and all steps are given; otherwise 0.
int order_of_steps(const Plan& plan, const PointResult& point) {
  int order = 0;
  for (std::uint64_t run = point.first_run; run < point.first_run + point.runs; ++run) {
    if (plan.points().replicate(run) > 0) continue;
    const Physics physics = plan.scenario(run).physics;
    const int own = physics.adapts() ? 0 : std::max(1, physics.integrator->order);
    if (own == 0 || (order > 0 && own != order)) return 0;
    order = own;
  }
  return order;
}

/// Score of the point at a vanishing step, if it agrees with the other engine. `half` and `other` must be results of runs
/// without failures and broken limits.
std::optional<Score> explained(const Plan& plan, const PointResult& point, const Score& half, const Score& other) {
  const int order = order_of_steps(plan, point);
  if (order == 0) return {};
  Score limit = half;
  for (std::size_t k = 0; k < plan.study().objectives.size(); ++k)
    limit.objectives[k] = step_limit(point.score.objectives[k], half.objectives[k], order);
  return changes(plan, limit, other).empty() ? std::optional(limit) : std::nullopt;
}

/// Reasons why a trial rejects its point, by kind; a text is empty without such a reason.
struct Objections {
  std::string failed;
  std::string changed;
  std::string broken;
  [[nodiscard]] bool any() const { return !failed.empty() || !changed.empty() || !broken.empty(); }
  [[nodiscard]] std::string text() const { return failed + changed + (changed.empty() || broken.empty() ? "" : "; ") + broken; }
};

Objections objections(const Plan& plan, const Journal& journal, const Trial& trial) {
  const PointResult is = result_of(journal, trial);
  Objections found{.failed = failure(plan, trial, is), .changed = "", .broken = ""};
  if (!found.failed.empty()) return found;
  found.changed = changes(plan, trial.point.score, is.score);
  found.broken = broken_limits(plan, trial, is);
  return found;
}

/// After each trial in the other engine that rejects its point and had too long steps, adds a trial with a quarter of the step.
/// The added trial then counts instead. Returns false if interrupted.
bool add_quarters(const Plan& plan, const Journal& journal, std::vector<Trial>& trials, const Executor& executor,
                  const TrialsTold& told, std::atomic<bool>& stop) {
  std::vector<Trial> quarters;
  for (const Trial& trial : trials) {
    const bool too_long = std::ranges::any_of(trial.rows, [&](const Row& row) { return had_long_steps(plan, row); });
    if (trial.kind != TrialKind::other_engine || !too_long || !objections(plan, journal, trial).any()) continue;
    quarters.push_back(
        {trial.point, TrialKind::quarter_step, trial.name, [&plan](std::uint64_t run) { return quartered(plan, run); }});
  }
  if (quarters.empty()) return true;
  if (!run_trials(plan, quarters, true, executor, told, stop)) return false;
  std::ranges::move(quarters, std::back_inserter(trials));
  return true;
}

/// Entries of a point with its trials.
std::vector<Verification> judged(const Plan& plan, Journal& journal, const std::vector<Trial>& tried,
                                 const PointResult& point) {
  std::vector<Verification> all{as_run(plan, journal, point)};
  std::vector<Score> scores;
  bool sound = true;
  bool changed = false;
  for (std::size_t k = 0; k < tried.size(); ++k) {
    all.push_back(without_reason(plan, journal, tried[k]));
    if (k + 1 < tried.size() && tried[k + 1].kind == TrialKind::quarter_step) continue;
    const Objections found = objections(plan, journal, tried[k]);
    all.back().reason = found.text();
    sound = sound && found.failed.empty() && found.broken.empty();
    changed = changed || !found.changed.empty();
    scores.push_back(result_of(journal, tried[k]).score);
  }
  if (!sound || !changed || scores.size() < 2) return all;
  const std::optional<Score> limit = explained(plan, point, scores.front(), scores.back());
  if (!limit) return all;
  for (std::size_t k = 1; k < all.size(); ++k) all[k].reason.clear();
  all.push_back(all[1]);
  all.back().kind = TrialKind::limit;
  all.back().name.clear();
  all.back().objectives.assign(limit->objectives.begin(),
                               limit->objectives.begin() + static_cast<std::ptrdiff_t>(plan.study().objectives.size()));
  return all;
}

}  // namespace

std::optional<std::vector<Verification>> verify(const Plan& plan, Journal& journal, const Results& results,
                                                const std::vector<std::size_t>& points, const Executor& executor,
                                                const TrialsTold& told, std::atomic<bool>& stop) {
  std::vector<Trial> trials;
  for (const std::size_t point : points) {
    for (Trial& trial : ways(plan, results.points[point])) trials.push_back(std::move(trial));
  }
  if (!run_trials(plan, trials, true, executor, told, stop)) return {};
  if (!add_quarters(plan, journal, trials, executor, told, stop)) return {};
  std::vector<Verification> all;
  for (const std::size_t k : points) {
    const PointResult& point = results.points[k];
    std::vector<Trial> own;
    std::ranges::copy_if(trials, std::back_inserter(own), [&](const Trial& trial) { return &trial.point == &point; });
    for (Verification& v : judged(plan, journal, own, point)) all.push_back(std::move(v));
  }
  return all;
}

std::optional<std::vector<Verification>> with_dead_joints(const Plan& plan, Journal& journal, const PointResult& point,
                                                          const Executor& executor, const TrialsTold& told,
                                                          std::atomic<bool>& stop) {
  std::vector<Trial> trials;
  const Scenario scenario = plan.scenario(point.first_run);
  for (const Joint& joint : scenario.robot->joints) {
    if (!joint.driven()) continue;
    const std::string set = fmt::format("at=[{{t: 0, fault: {{joint: {}, kind: dead}}}}]", joint.name);
    trials.push_back({point, TrialKind::dead_joint, joint.name, [set](std::uint64_t) { return std::vector{set}; }});
  }
  if (!run_trials(plan, trials, true, executor, told, stop)) return {};
  std::vector<Verification> all;
  for (const Trial& trial : trials) all.push_back(without_reason(plan, journal, trial));
  return all;
}

}  // namespace gaitlab::studies
