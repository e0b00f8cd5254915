#include "studies/search/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string_view>

#include "core/math/functions.h"
#include "core/settings/wording.h"
#include "studies/run/again.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

/// Another way to run a point. `sets` gives the settings for one of its runs.
struct Way {
  std::string what;
  std::function<std::vector<std::string>(const Plan& plan, std::uint64_t run)> sets;
};

std::vector<std::string> halved(const Plan& plan, std::uint64_t run) {
  const Physics physics = plan.scenario(run).physics;
  if (physics.adaptive_step) return {"physics.accuracy=" + number_text(physics.accuracy / 2)};
  return {"physics.step=" + number_text(physics.step / 2)};
}

std::vector<Way> ways(const Plan& plan) {
  std::vector<Way> ways;
  const Verify& verify = plan.study().verify;
  if (verify.halve_step) ways.push_back({"half step", halved});
  if (plan.bound().has_other_engine())
    ways.push_back({clipped(verify.engine), [](const Plan& of, std::uint64_t run) { return of.other_engine(run); }});
  return ways;
}

/// Largest difference between two points in a coordinate, as a share of its range. Different listed values give 1.
double apart(const Study& study, const std::vector<std::string>& a, const std::vector<std::string>& b) {
  double most = 0;
  for (std::size_t k = 0; k < study.parameters.size(); ++k) {
    const Parameter& p = study.parameters[k];
    if (!p.values.empty()) {
      if (a[k] != b[k]) return 1;
      continue;
    }
    const auto share = [&](const std::string& value) {
      const double number = number_of(value);
      return p.log ? math::log(number / p.low) / math::log(p.high / p.low) : (number - p.low) / (p.high - p.low);
    };
    most = std::max(most, std::abs(share(a[k]) - share(b[k])));
  }
  return most;
}

constexpr const char* kEvidence = "margin.evidence";  // a negative margin means that evidence is missing

/// Reason in a verdict not to verify a point, even if the check is not a guard; "" without a reason. `why` is the sentence
/// after the word.
std::string doubt(const std::string& word, double evidence, const std::string& why) {
  const std::string end = why.empty() ? "" : ": " + why;
  if (word == "infeasible") return "the verdict is infeasible" + end;
  return word == "not judged" && evidence < 0 ? word + end : "";
}

double evidence(const Plan& plan, const Row& row) {
  const auto at = std::ranges::find(plan.columns(), kEvidence, &Quantity::name);
  return row.quantities.at(static_cast<std::size_t>(at - plan.columns().begin()));
}

/// Text such as `in rubble: ` for a row, or "" if the study has only one scenario.
std::string in_scenario(const Row& row) { return row.scenario.empty() ? "" : "in " + row.scenario + ": "; }

/// Reason not to verify a point, or "" if the point is verified.
std::string reason(const Plan& plan, const std::vector<Row>& rows, const PointResult& was, const PointResult& is) {
  std::string why;
  const auto add = [&](const std::string& text) { why += (why.empty() ? "" : "; ") + text; };
  for (const Row& row : rows) {
    if (row.outcome != "done") return in_scenario(row) + row.outcome + ": " + row.message;
  }
  for (std::size_t k = 0; k < plan.study().objectives.size(); ++k) {
    const double then = was.score.objectives[k];
    const double now = is.score.objectives[k];
    if (!(std::abs(now - then) <= plan.study().verify.change * std::abs(then))) {
      add(fmt::format("{} is {:.4g} instead of {:.4g}, beyond the {:.3g} % of verify.change",
                      clipped(plan.scorer().objectives()[k]), now, then, 100 * plan.study().verify.change));
    }
  }
  for (const Row& row : rows) {
    const bool breaks = is.score.violation > 0 && row.score && row.score->violation > 0;
    const std::string doubted = doubt(row.verdict, evidence(plan, row), row.message);
    if (!breaks && doubted.empty()) continue;
    const std::vector<std::string> broken = plan.scorer().broken(row.quantities, row.verdict, row.message);
    const std::string of_verdict = row.verdict + (row.message.empty() ? "" : ": " + row.message);
    if (breaks) add(in_scenario(row) + fmt::format("{}", fmt::join(broken, ", ")));
    const bool said = breaks && std::ranges::find(broken, of_verdict) != broken.end();
    if (!doubted.empty() && !said) add(in_scenario(row) + doubted);
    break;  // only the first failing replicate is described
  }
  return why;
}

/// Entry for the original runs of a point.
Verification as_run(const Plan& plan, Journal& journal, const PointResult& point) {
  Verification own{point.first_run, "as run", {}, point.score.violation, "", ""};
  const std::vector<std::string> names = journal.columns().all();
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  for (std::uint64_t run = point.first_run; run < point.first_run + point.runs; ++run) {
    const std::vector<std::string> row = journal.row(run);
    const std::string& word = row[place("verdict")];
    if (own.verdict.empty()) own.verdict = word;
    const std::string doubted = doubt(word, number_of(row[place(kEvidence)]), row[place("message")]);
    if (doubted.empty() || !own.reason.empty()) continue;
    own.verdict = word;
    own.reason = in_scenario(plan.row(run)) + doubted;
  }
  for (std::size_t k = 0; k < plan.study().objectives.size(); ++k) own.objectives.push_back(point.score.objectives[k]);
  return own;
}

}  // namespace

std::vector<std::size_t> candidates(const Plan& plan, const Results& results) {
  constexpr double kApart = 0.01;
  const auto most = static_cast<std::size_t>(plan.study().verify.best);
  std::vector<JournalObjective> objectives;
  for (const Objective& o : plan.study().objectives) objectives.push_back({o.expression.text, o.maximize});
  std::vector<std::size_t> chosen;
  if (objectives.size() > 1) {
    const std::vector<std::size_t> all = front(results.points, objectives);
    const std::size_t count = std::min(most, all.size());
    for (std::size_t k = 0; k < count; ++k) chosen.push_back(all[count == 1 ? 0 : k * (all.size() - 1) / (count - 1)]);
    return chosen;
  }
  const auto values = [&](std::size_t k) { return plan.points().values(plan.points().point(results.points[k].first_run)); };
  for (const std::size_t k : ranked(results.points, objectives.front().maximize)) {
    if (chosen.size() == most || !results.points[k].kept()) break;
    const auto near = [&](std::size_t other) { return apart(plan.study(), values(k), values(other)) <= kApart; };
    if (std::ranges::none_of(chosen, near)) chosen.push_back(k);
  }
  return chosen;
}

namespace {

/// A point with another run of it: its rows, one per run of the point, and its result.
struct Tried {
  const PointResult& point;
  const Way& way;
  std::vector<Row> rows;
  PointResult is;
};

/// Verification without a reason.
Verification told_so(const Plan& plan, const Tried& tried) {
  Verification v{tried.point.first_run, tried.way.what, {}, tried.is.score.violation, tried.rows.front().verdict, ""};
  for (const Row& row : tried.rows) {
    if (row.verdict == "infeasible") v.verdict = row.verdict;
  }
  for (std::size_t k = 0; k < plan.study().objectives.size(); ++k)
    v.objectives.push_back(tried.is.failed > 0 ? std::nan("") : tried.is.score.objectives[k]);
  return v;
}

/// Runs each point in every way. The result is ordered by point, then by way. Nothing if `stop` was set.
std::optional<std::vector<Tried>> try_ways(const Plan& plan, Journal& journal, const std::vector<const PointResult*>& points,
                                           const std::vector<Way>& ways, const Executor& executor,
                                           const std::function<void(std::size_t done, std::size_t of)>& told,
                                           std::atomic<bool>& stop) {
  const std::uint64_t runs_of_point = plan.points().runs_of_point();
  std::vector<Job> jobs;
  std::vector<Tried> all;
  for (const PointResult* const point : points) {
    for (const Way& way : ways) {
      all.push_back({*point, way, std::vector<Row>(runs_of_point), {}});
      for (std::uint64_t r = 0; r < runs_of_point; ++r) {
        const std::uint64_t run = point->first_run + r;
        Job job{plan.row(run), plan.sets(run), plan.points().scenario(run)};
        job.row.run = jobs.size();
        std::ranges::copy(way.sets(plan, run), std::back_inserter(job.sets));
        jobs.push_back(std::move(job));
      }
    }
  }
  const Again again{.count = jobs.size(),
                    .job = [&](std::size_t k) { return jobs[k]; },
                    .take =
                        [&](std::vector<Row>&& ended) {
                          for (Row& row : ended) all[row.run / runs_of_point].rows[row.run % runs_of_point] = std::move(row);
                        },
                    .told = told};
  if (!do_again(again, executor, stop)) return {};
  for (Tried& one : all) {
    std::vector<Brief> briefs;
    for (std::size_t r = 0; r < runs_of_point; ++r) {
      const Row& row = one.rows[r];
      briefs.push_back({one.point.first_run + r, row.outcome, row.message, row.simulated, row.score, row.verdict});
    }
    one.is = point_result(journal.head(), briefs);
  }
  return all;
}

constexpr std::string_view kDead = " dead";

}  // namespace

std::optional<std::vector<Verification>> verify(const Plan& plan, Journal& journal, const Results& results,
                                                const std::vector<std::size_t>& points, const Executor& executor,
                                                const std::function<void(std::size_t done, std::size_t of)>& told,
                                                std::atomic<bool>& stop) {
  const std::vector<Way> how = ways(plan);
  std::vector<const PointResult*> chosen;
  for (const std::size_t point : points) chosen.push_back(&results.points[point]);
  const std::optional<std::vector<Tried>> tried = try_ways(plan, journal, chosen, how, executor, told, stop);
  if (!tried) return {};
  std::vector<Verification> all;
  std::size_t at = 0;
  for (const PointResult* const point : chosen) {
    all.push_back(as_run(plan, journal, *point));
    for (std::size_t k = 0; k < how.size(); ++k, ++at) {
      const Tried& one = (*tried)[at];
      all.push_back(told_so(plan, one));
      all.back().reason = reason(plan, one.rows, *point, one.is);
    }
  }
  return all;
}

std::optional<std::vector<Verification>> with_dead_joints(const Plan& plan, Journal& journal, const PointResult& point,
                                                          const Executor& executor,
                                                          const std::function<void(std::size_t done, std::size_t of)>& told,
                                                          std::atomic<bool>& stop) {
  std::vector<Way> how;
  const Scenario scenario = plan.scenario(point.first_run);
  for (const Joint& joint : scenario.robot->joints) {
    if (!joint.driven()) continue;
    const std::string set = fmt::format("at=[{{t: 0, fault: {{joint: {}, kind: dead}}}}]", joint.name);
    how.push_back({joint.name + std::string(kDead), [set](const Plan&, std::uint64_t) { return std::vector{set}; }});
  }
  const std::optional<std::vector<Tried>> tried = try_ways(plan, journal, {&point}, how, executor, told, stop);
  if (!tried) return {};
  std::vector<Verification> all;
  for (const Tried& one : *tried) all.push_back(told_so(plan, one));
  return all;
}

bool is_fault(const Verification& verification) { return verification.what.ends_with(kDead); }

std::vector<std::uint64_t> verified(const std::vector<Verification>& tried) {
  std::vector<std::uint64_t> runs;
  for (const Verification& v : tried) {
    const auto fell = [&](const Verification& other) { return other.run == v.run && !other.reason.empty(); };
    if (std::ranges::none_of(tried, fell) && std::ranges::find(runs, v.run) == runs.end()) runs.push_back(v.run);
  }
  return runs;
}

}  // namespace gaitlab::studies
