#include "studies/journal/results.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

/// Collects the replicates of each point, from runs in the order of their numbers.
class Gather {
 public:
  Gather(const JournalHead& head, Results& results) : head_(head), results_(results) {}

  void take(const Brief& run) {
    if (!runs_.empty() && run.run / head_.replicates != runs_.front().run / head_.replicates) finish();
    runs_.push_back(run);
  }

  void finish() {
    if (runs_.size() == head_.replicates) results_.points.push_back(point_result(head_, runs_));
    runs_.clear();
  }

 private:
  const JournalHead& head_;
  Results& results_;
  std::vector<Brief> runs_;
};

/// True if a run counts as failed. A stopped run with a score, which breaks a limit, counts like a completed one if a point
/// must not break a limit in any of its runs. The point is then not kept, and models learn from its score.
bool has_failed(const JournalHead& head, const Brief& run) {
  const bool every = head.combine == name_of(Combine::worst) || head.combine == name_of(Combine::mean);
  return !run.score || (run.outcome != name_of(Ended::done) && (run.outcome != name_of(Ended::stopped) || !every));
}

/// Largest violation of the nominal runs of a point in a robust study: the first replicate in each scenario. Infinite if one of
/// them failed.
double nominal_violation(const JournalHead& head, std::span<const Brief> runs) {
  const std::uint64_t in_scenario = head.replicates / std::max<std::size_t>(1, head.scenarios.size());
  double largest = 0;
  for (const Brief& run : runs) {
    if (run.run % head.replicates % in_scenario != 0) continue;
    largest = std::max(largest, has_failed(head, run) ? std::numeric_limits<double>::infinity() : run.score->violation);
  }
  return largest;
}

}  // namespace

PointResult point_result(const JournalHead& head, std::span<const Brief> runs) {
  PointResult point{runs.front().run / head.replicates * head.replicates, runs.size(), 0, {}};
  std::array<std::vector<double>, kMostObjectives> bad;  // values per objective; larger is worse
  std::vector<double> violation;
  for (const Brief& run : runs) {
    if (run.verdict == Word::feasible) ++point.feasible_runs;
    if (run.verdict == Word::infeasible) ++point.infeasible_runs;
    if (has_failed(head, run)) {
      point.lived = point.failed == 0 ? run.simulated : std::min(point.lived, run.simulated);
      ++point.failed;
      continue;
    }
    point.stopped += run.outcome == name_of(Ended::stopped) ? 1 : 0;
    for (std::size_t k = 0; k < head.objectives.size(); ++k)
      bad[k].push_back(head.objectives[k].maximize ? -run.score->objectives[k] : run.score->objectives[k]);
    violation.push_back(run.score->violation);
  }
  // `share` keeps a point if this share of its replicates breaks no limit. A failed replicate breaks every limit.
  const bool robust = head.combine == name_of(Combine::robust);
  const bool shared = robust || head.combine == name_of(Combine::share);
  const double nominal = robust ? nominal_violation(head, runs) : 0;
  if (shared && !violation.empty()) {
    violation.resize(violation.size() + point.failed, std::numeric_limits<double>::infinity());
    if (std::isfinite(combined(violation, "quantile", head.quantile)) && std::isfinite(nominal)) point.failed = 0;
  }
  if (point.failed > 0) return point;
  point.score.violation = std::max(combined(violation, shared ? "quantile" : head.combine, head.quantile), nominal);
  for (std::size_t k = 0; k < head.objectives.size(); ++k) {
    const double worse = combined(bad[k], robust ? name_of(Combine::share) : head.combine, head.quantile);
    point.score.objectives[k] = head.objectives[k].maximize ? -worse : worse;
  }
  return point;
}

double combined(std::vector<double> values, const std::string& how, double quantile) {
  if (how == "share") std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return std::nan("");
  if (std::ranges::any_of(values, [](double v) { return std::isnan(v); })) return std::nan("");
  std::ranges::sort(values);
  if (how == "mean" || how == "share")
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  if (how == "median") {
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  }
  if (how == "quantile") {
    constexpr double kRounding = 1e-9;  // as doubles, 0.07 * 100 is above 7
    const double at = std::ceil(quantile * static_cast<double>(values.size()) - kRounding) - 1;
    return values[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(values.size() - 1)))];
  }
  return values.back();
}

Results results(Journal& journal) {
  Results results;
  Gather gather(journal.head(), results);
  journal.each_brief([&](const Brief& run) {
    ++results.runs;
    if (run.score && run.score->kept()) ++results.kept_runs;
    if (run.verdict == Word::feasible) ++results.feasible_runs;
    if (run.outcome != "done") {
      Failures::One& one = results.failures.by_outcome[run.outcome];
      if (one.count++ == 0) one = {1, run.run, run.message};
    }
    gather.take(run);
  });
  gather.finish();
  return results;
}

void Estimated::add(double share) {
  ++runs;
  worst = std::max(worst, share);
  beyond_small += share > kSmall ? 1 : 0;
  beyond_most += share > most ? 1 : 0;
}

Estimated estimated(Journal& journal) {
  Estimated found(journal.head());
  const std::string column = journal.column_of(kTorqueError);
  if (column.empty()) return found;
  journal.each_numbers({column}, [&](std::span<const double> values) {
    if (std::isnan(values.front())) {
      ++found.others;
    } else {
      found.add(values.front());
    }
  });
  return found;
}

std::vector<BrokenLimit> broken_limits(Journal& journal) {
  const JournalHead& head = journal.head();
  std::vector<std::string> columns{"run"};  // `run` ensures that the query has at least one column
  const Names names = [&](const std::string& name, const std::string& joint) -> Naming {
    const std::string full = joint.empty() ? name : name + "[" + joint + "]";
    const std::string column = journal.column_of(full);
    if (column.empty()) return {{}, "unknown"};
    const auto known = std::ranges::find(columns, column);
    const auto place = static_cast<std::size_t>(known - columns.begin());
    if (known == columns.end()) columns.push_back(column);
    return {place};
  };
  std::vector<std::pair<Formula, bool>> formulas;  // relations, with true for a guard
  std::vector<BrokenLimit> limits;
  for (const Limit& limit : head.limits) {
    Problems problems;
    Formula formula({limit.text, {}}, names, problems);
    const bool relation = formula.compares("<=") || formula.compares(">=") || formula.compares("==");
    if (!problems.empty() || !relation) continue;  // a forged journal can contain other texts
    formulas.emplace_back(std::move(formula), limit.guard);
    limits.push_back({limit.text});
  }
  if (limits.empty()) return limits;
  journal.each_numbers(columns, [&](std::span<const double> values) {
    for (std::size_t k = 0; k < formulas.size(); ++k) {
      if (broken(formulas[k].first, values, formulas[k].second) > 0) ++limits[k].runs;
    }
  });
  std::erase_if(limits, [](const BrokenLimit& limit) { return limit.runs == 0; });
  std::ranges::stable_sort(limits, std::ranges::greater(), &BrokenLimit::runs);
  return limits;
}

bool better(const PointResult& a, const PointResult& b, bool maximize) {
  const auto rank = [](const PointResult& p) { return p.failed > 0 ? 2 : p.kept() ? 0 : 1; };
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  if (a.failed > 0) return a.lived != b.lived ? a.lived > b.lived : a.first_run < b.first_run;
  const double x = a.kept() ? (maximize ? -a.score.objective() : a.score.objective()) : a.score.violation;
  const double y = b.kept() ? (maximize ? -b.score.objective() : b.score.objective()) : b.score.violation;
  return x != y ? x < y : a.first_run < b.first_run;
}

std::vector<std::size_t> front(const std::vector<PointResult>& points, const std::vector<JournalObjective>& objectives) {
  std::vector<std::size_t> order = ranked(points, objectives.front().maximize);
  std::erase_if(order, [&](std::size_t k) { return !points[k].kept(); });
  const auto at_least = [&](const PointResult& a, const PointResult& b) {
    for (std::size_t k = 0; k < objectives.size(); ++k) {
      const double x = a.score.objectives[k];
      const double y = b.score.objectives[k];
      if (objectives[k].maximize ? x < y : x > y) return false;
    }
    return true;
  };
  std::vector<std::size_t> kept;
  for (const std::size_t k : order) {
    const auto beats = [&](std::size_t other) { return at_least(points[other], points[k]); };
    if (std::ranges::any_of(kept, beats)) continue;
    std::erase_if(kept, [&](std::size_t other) { return at_least(points[k], points[other]); });
    kept.push_back(k);
  }
  return kept;
}

std::vector<std::size_t> ranked(const std::vector<PointResult>& points, bool maximize) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return better(points[a], points[b], maximize); });
  return order;
}

}  // namespace gaitlab::studies
