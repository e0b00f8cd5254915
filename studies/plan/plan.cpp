#include "studies/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/files/hash.h"
#include "core/math/random.h"
#include "studies/journal/results.h"
#include "studies/plan/draws.h"
#include "studies/plan/worlds.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

Plan::Plan(Study study, const QuantityOffer& offer, Catalog& catalog)
    : bound_(std::move(study), offer, catalog), scenario_digest_(hash128(bound_.scenario_text())), points_(bound_.study()) {
  Problems problems = bound_.problems();
  check_settings(problems);
  problems.raise();
  all_estimated_ = draws_too_few();
}

std::map<std::string, double> Plan::nominal(const std::vector<std::string>& values, std::size_t scenario) const {
  std::map<std::string, double> nominal = scenarios()[scenario].nominal_values;
  for (const auto& [key, value] : bound_.followers().settings(values)) nominal[key] = number_of(value);
  return nominal;
}

std::vector<std::string> Plan::sets(std::uint64_t run) const { return sets(points_.values(points_.point(run)), run); }

/// Settings of a run as if its point had these values.
std::vector<std::string> Plan::sets(const std::vector<std::string>& values, std::uint64_t run) const {
  std::vector<std::string> sets;
  for (const auto& [key, value] : bound_.followers().settings(values)) sets.push_back(fmt::format("{}={}", key, value));
  if (study().robust) {
    const std::vector<std::string> world = of_world(sets, run);
    sets.insert(sets.end(), world.begin(), world.end());
  }
  if (study().robust || study().replicates.count == 0) return sets;
  const std::uint64_t replicate = points_.replicate(run);
  const std::vector<std::string> drawn = points_.drawn(replicate, nominal(values, points_.scenario(run)));
  for (std::size_t k = 0; k < drawn.size(); ++k) sets.push_back(study().replicates.vary[k].key + "=" + drawn[k]);
  sets.push_back(fmt::format("seed={}", points_.seed(replicate)));
  return sets;
}

std::vector<std::string> Plan::of_world(const std::vector<std::string>& sets, std::uint64_t run) const {
  const std::uint64_t replicate = points_.replicate(run);
  if (replicate == 0) return {};
  try {
    return worlds(with(sets, points_.scenario(run))).at(bound_.robust_worlds().at(replicate - 1)).sets;
  } catch (const InputError&) {
    return {};  // the run itself reports the reason
  }
}

std::int64_t Plan::seed(std::uint64_t run) const {
  const Scenario& nominal = scenarios()[points_.scenario(run)].nominal;
  const std::uint64_t replicate = points_.replicate(run);
  if (study().robust && replicate > 0) return worlds(nominal).at(bound_.robust_worlds().at(replicate - 1)).seed;
  return study().robust || study().replicates.count == 0 ? nominal.seed : points_.seed(replicate);
}

bool Plan::raise_budget(std::uint64_t runs) {
  if (study().runs == 0) return false;
  const std::uint64_t each = points_.runs_of_point();
  bound_.set_runs(std::max(study().runs, static_cast<std::int64_t>((runs + each - 1) / each * each)));
  return true;
}

std::string Plan::point_name(const std::vector<std::string>& values) const {
  std::string name = scenario_digest_;
  for (std::size_t k = 0; k < values.size(); ++k) name += fmt::format("{}={}\n", study().parameters[k].key, values[k]);
  const auto own = [](const Parameter& p) { return !p.sets.empty(); };
  if (std::ranges::any_of(study().parameters, own)) {  // followers may differ between studies
    for (const auto& [key, value] : bound_.followers().settings(values)) name += fmt::format("{}={}\n", key, value);
  }
  return hash128(name);
}

Row Plan::row(std::uint64_t run) const {
  Row row;
  row.run = run;
  row.values = points_.values(points_.point(run));
  row.point = point_name(row.values);
  const std::size_t scenario = points_.scenario(run);
  row.scenario = scenarios()[scenario].name;
  row.replicate = points_.replicate(run);
  if (!study().replicates.vary.empty()) {
    const std::vector<std::string> drawn = points_.drawn(row.replicate, nominal(row.values, scenario));
    row.values.insert(row.values.end(), drawn.begin(), drawn.end());
  }
  row.seed = seed(run);
  return row;
}

bool Plan::estimates(const std::string& point) const { return all_estimated_ || drawn_for_estimate(point); }

/// True if the random choice gives an estimate to fewer than Estimated::kFewest runs of a study with fixed points.
bool Plan::draws_too_few() const {
  if (study().estimate_every <= 1 || study().asked || is_search(study().method)) return false;
  std::uint64_t runs = 0;
  for (std::uint64_t p = 0; p < points_.points() && runs < Estimated::kFewest; ++p) {
    if (drawn_for_estimate(point_name(points_.values(p)))) runs += points_.runs_of_point();
  }
  return runs < Estimated::kFewest;
}

bool Plan::drawn_for_estimate(const std::string& point) const {
  const auto every = static_cast<std::uint64_t>(study().estimate_every);
  if (every == 0) return false;
  std::uint64_t name = 0;  // first 64 of the 128 bits
  std::from_chars(point.data(), point.data() + std::min<std::size_t>(point.size(), 16), name, 16);
  return math::hash64({kEstimateDraw, static_cast<std::uint64_t>(study().seed), name}) % every == 0;
}

void Plan::finish(Row& row, const Scenario& scenario, const Recording& recording, const Measure& measure) const {
  row.simulated = recording.simulated;
  row.outcome = name_of(recording.outcome.ended);
  const bool done = recording.outcome.done();
  if (!done) {
    row.message = recording.outcome.message;
    row.verdict = Word::failed;
  }
  if (!done && recording.outcome.ended != Ended::stopped) return;
  RunMeasured measured = measure(scenario, recording);
  row.quantities = std::move(measured.quantities);
  if (done) {
    row.verdict = measured.verdict;
    row.message = std::move(measured.why);
    row.cause = std::move(measured.cause);
  }
  score(row);
}

void Plan::score(Row& row) const {
  row.score = scorer().score(row.quantities, row.verdict);
  if (row.outcome != name_of(Ended::done) && row.score->kept()) row.score.reset();
}

}  // namespace gaitlab::studies
