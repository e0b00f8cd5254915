#include "report/remedy/remedy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/scenario/resolved.h"
#include "report/analysis/collisions.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kFarthest = 5;        // largest factor; its inverse is the smallest
constexpr int kPointsEachWay = 4;      // geometric points of a setting in a direction
constexpr int kCuts = 3;               // interior points of a bracket that are tried at once
constexpr double kTolerance = 0.02;    // width of the last bracket, as a share of the change
constexpr double kLess = 0.9;          // share of the change that must not suffice
constexpr int kMostRounds = 6;         // attempts to confirm an answer
constexpr int kMapEachWay = 6;         // cells of the map on either side of the run
constexpr std::size_t kMostPairs = 5;  // pairs to confirm, the fastest first
constexpr double kRunsPerAnswer = 8;   // for the estimate of the work only

/// Settings multiplied together, each by a factor.
using Change = std::vector<std::pair<const RemedyKey*, double>>;

std::string spaced(std::string id) {
  std::ranges::replace(id, '_', ' ');
  return id;
}

std::string name(const Check& check) { return spaced(check.id) + (check.worst.empty() ? "" : " of " + check.worst); }

/// Deciding check of a verdict and its part; for a feasible run the check with the least margin.
std::string weakest(const Verdict& verdict) {
  const std::vector<const Check*> failures = verdict.failures();
  if (verdict.word == Word::not_judged) {
    const auto close = std::ranges::find(verdict.checks, CheckStatus::too_close, &Check::status);
    const bool only = failures.empty() && close != verdict.checks.end() && verdict.reason == close->text;
    return only ? name(*close) + " is too close to its limit" : verdict.reason;
  }
  const Check* const check = failures.empty() ? verdict.tightest() : failures.front();
  return check == nullptr ? "" : name(*check);
}

RemedyRun judged(const Scenario& scenario, const Recording& recording) {
  const Summary summary = summarise(scenario, recording, 0);
  const Verdict made = verdict(scenario, recording, summary, overlaps(scenario, recording));
  const Check* const tightest = made.tightest();
  return {made.word, tightest == nullptr ? kNone : tightest->margin, summary.speed, weakest(made)};
}

/// Rounds to a hundredth of the change or finer: up if `up`, else down.
double rounded(double value, double now, bool up) {
  const double change = std::abs(value - now);
  if (!(change > 0)) return value;
  const double unit = std::pow(10, std::floor(std::log10(change)) - 2);
  const double count = value / unit;
  constexpr double kSame = 1e-6;  // the value itself, in spite of rounding errors
  return (up ? std::ceil(count - kSame) : std::floor(count + kSame)) * unit;
}

class Search {
 public:
  Search(const RemedyTask& task, std::atomic<bool>& stop)
      : task_(task), stop_(stop), settings_(resolved(task.scenario)), own_(task.scenario.physics.engine->name) {
    made_.word = task.verdict.word;
    made_.engine = "articulated";
    // Without an engine `articulated` for this scenario, the search uses its own engine.
    if (own_ != made_.engine) {
      faster_ = {"physics.engine=articulated", "physics.integrator=adaptive", "physics.step=auto", "physics.accuracy=0.01"};
      try {
        (void)task_.with(faster_);
      } catch (const InputError&) {
        faster_.clear();
        made_.engine = own_;
      }
    }
  }

  Remedy made() {
    add_ratings();
    for (const RemedyKey& key : remedy_keys()) {
      if (!task_.by.empty() && std::ranges::count(task_.by, key.name) == 0) continue;
      if (settings_.has(key)) {
        for (const bool up : {false, true}) made_.answers.push_back({.key = &key, .up = up});
      } else {
        made_.lacking.push_back(&key);
      }
    }
    expected_ = static_cast<double>(made_.answers.size()) * (kPointsEachWay + kRunsPerAnswer) + (task_.map ? cells() : 0);
    find_brackets();
    narrow();
    confirm();
    const bool helps = std::ranges::any_of(made_.answers, [](const RemedyAnswer& a) { return a.crosses && a.confirmed; });
    const bool pairs =
        !feasible() && !helps && task_.by.empty() && has("frequency") && has("amplitude") && !made_.ratings_suffice;
    if (pairs || (task_.map && has("frequency") && has("amplitude"))) draw_map();
    if (pairs) find_pair();
    return std::move(made_);
  }

 private:
  /// Interval of factors at whose ends the verdicts differ.
  struct Bracket {
    RemedyAnswer* answer;
    double inner, outer;
    [[nodiscard]] bool wide() const { return std::abs(outer - inner) > kTolerance * std::abs(outer - 1); }
  };

  [[nodiscard]] bool feasible() const { return made_.word == Word::feasible; }
  static double cells() { return std::pow(2 * kMapEachWay + 1, 2); }
  [[nodiscard]] bool has(const std::string& name) const { return settings_.has(key(name)); }
  static const RemedyKey& key(const std::string& name) {
    return *std::ranges::find_if(remedy_keys(), [&](const RemedyKey& k) { return k.name == name; });
  }

  [[nodiscard]] std::vector<std::string> sets(const Change& change) const {
    std::vector<std::string> all;
    for (const auto& [key, factor] : change) {
      for (std::string& set : settings_.scaled(*key, factor)) all.push_back(std::move(set));
    }
    return all;
  }

  /// Runs with the changes. `confirming` runs have the engine, step and estimate of the scenario.
  std::vector<RemedyRun> run(const std::vector<Change>& changes, bool confirming) {
    std::vector<RemedyRun> results(changes.size());
    std::vector<Scenario> scenarios;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      std::vector<std::string> all = sets(changes[i]);
      if (!confirming) all.insert(all.begin(), faster_.begin(), faster_.end());
      try {
        scenarios.push_back(task_.with(all));
      } catch (const InputError& error) {
        results[i] = {Word::failed, kNone, kNone, error.problems().front().text};
        continue;
      }
      if (!confirming) {
        scenarios.back().physics.estimate = Estimate::off;
        scenarios.back().physics.estimated_by_others = true;
      }
      numbers.push_back(i);
    }
    const auto judge = [&](std::size_t k, RolloutEnd&& end) {
      RemedyRun& result = results[numbers[k]];
      result = end.refused.empty() ? judged(scenarios[k], end.recording)
                                   : RemedyRun{Word::failed, kNone, kNone, end.refused.front().text};
      tell(1);
    };
    run_all(scenarios, task_.batch, kVerdictReads, stop_, judge);
    if (stop_) throw Stopped{};
    made_.runs += scenarios.size();
    return results;
  }

  void tell(double more) {
    const double done = done_.fetch_add(more) + more;
    if (task_.progress) task_.progress(std::min(0.99, done / expected_));
  }

  void add_ratings() {
    const std::vector<const Check*> failures = task_.verdict.failures();
    made_.ratings_suffice = task_.verdict.word == Word::infeasible;
    for (const Check* check : failures) {
      const auto kind = std::ranges::find_if(check_kinds(), [&](const CheckKind& k) { return k.id == check->id; });
      if (!kind->rating) {
        made_.ratings_suffice = false;
        continue;
      }
      const double most = check->value * (1 + check->error);
      const std::string setting = kind->key;
      made_.ratings.push_back({check->id, check->worst, setting.substr(setting.rfind('.') + 1), rounded(most, 0, true),
                               check->limit, check->unit, check->parts});
    }
  }

  /// Tries the geometric points of every setting, and finds the first change of the verdict in each direction.
  void find_brackets() {
    const double step = std::pow(kFarthest, 2.0 / (2 * kPointsEachWay - 1));
    std::vector<Change> changes;
    std::vector<double> factors;
    for (const RemedyAnswer& answer : made_.answers) {
      for (int k = 0; k < kPointsEachWay; ++k) {
        const double factor = std::pow(step, (answer.up ? 1 : -1) * (k + 0.5));
        factors.push_back(factor);
        changes.push_back({{answer.key, factor}});
      }
    }
    const std::vector<RemedyRun> runs = run(changes, false);
    for (std::size_t a = 0; a < made_.answers.size(); ++a) {
      RemedyAnswer& answer = made_.answers[a];
      double inner = 1;
      for (std::size_t k = a * kPointsEachWay; k < (a + 1) * kPointsEachWay; ++k) {
        if (answer.crosses && runs[k].feasible() == feasible()) break;
        answer.farthest = runs[k];
        answer.until = factors[k];
        if (!answer.crosses && runs[k].feasible() != feasible()) {
          answer.crosses = true;
          brackets_.push_back({&answer, inner, factors[k]});
          if (feasible()) break;
        }
        inner = factors[k];
      }
    }
  }

  void narrow() {
    for (;;) {
      std::vector<Bracket*> wide;
      std::vector<Change> changes;
      for (Bracket& bracket : brackets_) {
        if (!bracket.wide()) continue;
        wide.push_back(&bracket);
        for (int k = 1; k <= kCuts; ++k) changes.push_back({{bracket.answer->key, between(bracket, k)}});
      }
      if (wide.empty()) return;
      const std::vector<RemedyRun> runs = run(changes, false);
      for (std::size_t b = 0; b < wide.size(); ++b) {
        const Bracket old = *wide[b];
        for (int k = 1; k <= kCuts; ++k) {
          const RemedyRun& tried = runs[b * kCuts + static_cast<std::size_t>(k) - 1];
          if (tried.feasible() == feasible()) {
            wide[b]->inner = between(old, k);
          } else {
            wide[b]->outer = between(old, k);
            break;
          }
        }
      }
    }
  }

  static double between(const Bracket& bracket, int cut) {
    return bracket.inner + (bracket.outer - bracket.inner) * cut / (kCuts + 1);
  }

  /// The factor with a rounded value, on the safe side: farther from 1, or nearer to 1 for a feasible gait.
  [[nodiscard]] double safe(const RemedyAnswer& answer, double factor) const {
    const double now = settings_.value(*answer.key);
    const bool up = answer.up != feasible();
    return std::isnan(now) ? rounded(factor, 1, up) : rounded(now * factor, now, up) / now;
  }

  void confirm() {
    std::vector<RemedyAnswer*> open;
    std::map<const RemedyAnswer*, double> searched;  // factors by the search
    for (const Bracket& bracket : brackets_) {
      RemedyAnswer& answer = *bracket.answer;
      answer.factor = safe(answer, feasible() ? bracket.inner : bracket.outer);
      searched[bracket.answer] = answer.factor;
      if (answer.factor != 1) open.push_back(&answer);
    }
    for (int round = 0; round < kMostRounds && !open.empty(); ++round) {
      std::vector<Change> changes;
      for (const RemedyAnswer* answer : open) {
        changes.push_back({{answer->key, answer->factor}});
        if (!feasible()) changes.push_back({{answer->key, 1 + kLess * (answer->factor - 1)}});
      }
      const std::vector<RemedyRun> runs = run(changes, true);
      std::vector<RemedyAnswer*> still;
      for (std::size_t a = 0; a < open.size(); ++a) {
        const std::size_t at = feasible() ? a : 2 * a;
        if (!settle(*open[a], runs[at], !feasible() && runs[at + 1].feasible())) still.push_back(open[a]);
      }
      open = std::move(still);
    }
    for (RemedyAnswer& answer : made_.answers) {
      if (!answer.crosses) continue;
      if (!answer.confirmed) answer.factor = searched[&answer];
      answer.sets = settings_.scaled(*answer.key, answer.factor);
      if (feasible() || std::abs(answer.until - 1) < std::abs(answer.factor - 1)) answer.until = answer.factor;
    }
  }

  /// Takes the result of a confirming run. Returns false, with another factor to try, unless the answer is final.
  [[nodiscard]] bool settle(RemedyAnswer& answer, const RemedyRun& with, bool less_suffices) const {
    answer.run = with;
    const double change = answer.factor - 1;
    if (with.feasible() && !less_suffices) {
      answer.confirmed = true;
      return true;
    }
    const double grown = feasible() || with.feasible() ? kLess : 1.08;
    const double next = safe(answer, 1 + grown * change);
    if (next == answer.factor || next == 1) return true;
    answer.factor = next;
    return false;
  }

  void draw_map() {
    RemedyMap map;
    for (int k = -kMapEachWay; k <= kMapEachWay; ++k) map.factors.push_back(std::pow(kFarthest, k / double{kMapEachWay}));
    std::vector<Change> changes;
    for (const double amplitude : map.factors) {
      for (const double frequency : map.factors)
        changes.push_back({{&key("frequency"), frequency}, {&key("amplitude"), amplitude}});
    }
    map.runs = run(changes, false);
    made_.map = std::move(map);
  }

  void find_pair() {
    const RemedyMap& map = *made_.map;
    std::vector<std::size_t> cells;
    for (std::size_t k = 0; k < map.runs.size(); ++k) {
      if (map.runs[k].feasible()) cells.push_back(k);
    }
    std::ranges::stable_sort(cells, std::greater{}, [&](std::size_t k) { return map.runs[k].speed; });
    cells.resize(std::min(cells.size(), kMostPairs));
    for (const std::size_t cell : cells) {
      RemedyPair pair{map.factors[cell % map.factors.size()], map.factors[cell / map.factors.size()]};
      const Change change{{&key("frequency"), pair.frequency}, {&key("amplitude"), pair.amplitude}};
      pair.run = run({change}, true).front();
      pair.confirmed = pair.run.feasible();
      pair.sets = sets(change);
      if (!pair.confirmed) continue;
      made_.pair = std::move(pair);
      return;
    }
  }

 public:
  struct Stopped {};

 private:
  const RemedyTask& task_;
  std::atomic<bool>& stop_;
  RemedySettings settings_;
  std::string own_;
  std::vector<std::string> faster_;  ///< settings of the search
  std::vector<Bracket> brackets_;
  std::atomic<double> done_ = 0;
  double expected_ = 1;
  Remedy made_;
};

}  // namespace

std::optional<Remedy> remedy(const RemedyTask& task, std::atomic<bool>& stop) {
  if (task.verdict.word == Word::not_judged) {
    throw InputError(SourceLocation{task.scenario.file},
                     "a remedy needs a verdict, but this run is not judged: " + task.verdict.reason);
  }
  try {
    return Search(task, stop).made();
  } catch (const Search::Stopped&) {
    return {};
  }
}

}  // namespace gaitlab::report
