#include "studies/search/world_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "studies/plan/worlds.h"

namespace gaitlab::studies {

namespace {

/// One trial of a point for each world that applies in any scenario.
std::vector<Trial> world_trials(const Plan& plan, const PointResult& point) {
  std::map<std::uint64_t, std::vector<World>> of_run;
  for (std::uint64_t run = point.first_run; run < point.first_run + point.runs; ++run) {
    if (plan.points().replicate(run) == 0) of_run[run] = worlds(plan.scenario(run));
  }
  std::vector<Trial> trials;
  for (std::size_t w = 0; w < kWorlds; ++w) {
    std::map<std::uint64_t, std::vector<std::string>> sets;
    for (const auto& [run, all] : of_run) sets[run] = all[w].sets;
    if (std::ranges::none_of(of_run, [w](const auto& one) { return one.second[w].applies; })) continue;
    const World& world = of_run.begin()->second[w];
    trials.push_back({point, world.drawn ? TrialKind::drawn_world : TrialKind::world, world.text(),
                      [sets](std::uint64_t run) { return sets.at(run); }, true});
  }
  return trials;
}

/// Reason why a point falls in a world.
struct Fall {
  std::string text = {};   ///< reason in few words; "" if the point stands
  std::string check = {};  ///< id of the check that decided the verdict; "" if none did
};

/// Reason in the first scenario where the point falls.
Fall fall(const Plan& plan, Trial& trial) {
  for (Row& row : trial.rows) {
    if (row.outcome != "done") return {in_scenario(row) + row.outcome + (row.message.empty() ? "" : ": " + row.message)};
    row.score = plan.scorer().score(row.quantities, row.verdict, false);
    const bool against = speaks_against(row.verdict, evidence(plan, row));
    if (row.score->violation == 0 && !against) continue;
    std::vector<std::string> causes = plan.scorer().broken(row.quantities, row.verdict, "", false);
    std::erase(causes, name_of(row.verdict));
    const bool decided = row.verdict != Word::feasible && !row.cause.check.empty();
    if (row.verdict != Word::feasible) causes.push_back(decided ? row.cause.text() : name_of(row.verdict));
    return {
        in_scenario(row) + (causes.empty() ? std::string(name_of(row.verdict)) : fmt::format("{}", fmt::join(causes, ", "))),
        decided ? row.cause.check : ""};
  }
  return {};
}

/// Runs of the points in `tried`, each once, in their order.
std::vector<std::uint64_t> points_of(const std::vector<Verification>& tried) {
  std::vector<std::uint64_t> runs;
  for (const Verification& v : tried) {
    if (std::ranges::find(runs, v.run) == runs.end()) runs.push_back(v.run);
  }
  return runs;
}

/// Value that ranks a point: the limit of vanishing steps if it is known, else that of its first entry.
double value_of(const std::vector<Verification>& tried, std::uint64_t run) {
  double value = std::nan("");
  for (const Verification& v : tried) {
    if (v.run == run && !v.objectives.empty() && (std::isnan(value) || v.kind == TrialKind::limit))
      value = v.objectives.front();
  }
  return value;
}

/// Entry with the number of worlds in which a point stands.
Verification share_entry(const Plan& plan, const std::vector<Verification>& tried, std::uint64_t run) {
  const WorldCount count = counted_worlds(tried, run);
  const std::size_t least = needed(plan.study().verify.share, count.of);
  const auto first = std::ranges::find(tried, run, &Verification::run);
  Verification entry{run, TrialKind::worlds, "", first->objectives, 0, first->verdict, ""};
  entry.objectives.front() = value_of(tried, run);
  if (count.stood < least) entry.reason = fmt::format("stands in {} of {} worlds; {} are needed", count.stood, count.of, least);
  return entry;
}

}  // namespace

bool is_world(const Verification& v) { return v.kind == TrialKind::world || v.kind == TrialKind::drawn_world; }

std::size_t needed(double share, std::size_t of) {
  constexpr double kRounding = 1e-9;  // as doubles, 0.07 * 100 is above 7
  return static_cast<std::size_t>(std::max(0.0, std::ceil(share * static_cast<double>(of) - kRounding)));
}

WorldCount counted_worlds(const std::vector<Verification>& tried, std::uint64_t run) {
  WorldCount count;
  for (const Verification& v : tried) {
    if (v.run != run || !is_world(v)) continue;
    const bool drawn = v.kind == TrialKind::drawn_world;
    ++count.of;
    count.drawn += drawn ? 1 : 0;
    if (v.reason.empty()) {
      ++count.stood;
    } else if (drawn) {
      ++count.fell_drawn;
    } else {
      count.falls.push_back(v);
    }
  }
  return count;
}

std::optional<std::vector<Verification>> in_worlds(const Plan& plan, Journal& journal, const Results& results,
                                                   const std::vector<Verification>& tried, const Executor& executor,
                                                   const TrialsTold& told, std::atomic<bool>& stop) {
  std::vector<Trial> trials;
  for (const std::uint64_t run : verified(tried)) {
    const auto point = std::ranges::find(results.points, run, &PointResult::first_run);
    for (Trial& trial : world_trials(plan, *point)) trials.push_back(std::move(trial));
  }
  if (!run_trials(plan, trials, false, executor, told, stop)) return {};
  std::vector<Verification> all = tried;
  for (Trial& trial : trials) {
    Fall why = fall(plan, trial);
    all.push_back(without_reason(plan, journal, trial));
    all.back().reason = std::move(why.text);
    all.back().check = std::move(why.check);
  }
  for (const std::uint64_t run : verified(tried)) all.push_back(share_entry(plan, all, run));
  return ranked_by_share(all, plan.study().objectives.front().maximize);
}

std::vector<Verification> ranked_by_share(const std::vector<Verification>& tried, bool maximize) {
  const std::vector<std::uint64_t> stood = verified(tried);
  std::vector<std::uint64_t> runs = points_of(tried);
  const auto key = [&](std::uint64_t run) {
    const double value = value_of(tried, run);
    return std::tuple(std::ranges::find(stood, run) == stood.end(), -counted_worlds(tried, run).share(),
                      maximize ? -value : value);
  };
  std::ranges::stable_sort(runs, {}, key);
  std::vector<Verification> ordered;
  for (const std::uint64_t run : runs) {
    std::ranges::copy_if(tried, std::back_inserter(ordered), [&](const Verification& v) { return v.run == run; });
  }
  return ordered;
}

std::vector<std::uint64_t> verified(const std::vector<Verification>& tried) {
  std::vector<std::uint64_t> runs = points_of(tried);
  std::erase_if(runs, [&](std::uint64_t run) {
    return std::ranges::any_of(tried, [&](const Verification& v) { return v.run == run && !is_world(v) && !v.reason.empty(); });
  });
  return runs;
}

}  // namespace gaitlab::studies
