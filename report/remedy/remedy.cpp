#include "report/remedy/remedy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "core/files/hash.h"
#include "core/scenario/resolved.h"
#include "report/analysis/collisions.h"
#include "report/verdict/load_checks.h"
#include "report/verdict/number_texts.h"

namespace gaitlab::report {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kFarthest = 5;        // largest factor; its inverse is the smallest
constexpr int kPointsEachWay = 4;      // geometric points of a setting in a direction
constexpr int kCuts = 3;               // interior points of a bracket that are tried at once
constexpr double kTolerance = 0.02;    // width of the last bracket, as a share of the change
constexpr double kLess = 0.9;          // share of the change that must not suffice
constexpr double kNarrowest = 1e-3;    // least width of a bracket, for changes close to the present value
constexpr double kMore = 1.08;         // factor on the logarithm of a change that does not suffice
constexpr int kMostRounds = 8;         // attempts to confirm an answer
constexpr int kMapEachWay = 6;         // cells of the map on either side of the run
constexpr std::size_t kMostPairs = 5;  // pairs to confirm, the fastest first
constexpr double kRunsPerAnswer = 8;   // for the estimate of the work only

/// Settings multiplied together, each by a factor.
using Change = std::vector<std::pair<const RemedyKey*, double>>;

std::string name(const Check& check) { return texts::spaced(check.id) + (check.worst.empty() ? "" : " of " + check.worst); }

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
  const auto progress = std::ranges::find(made.checks, "progress", &Check::id);
  const bool still = progress != made.checks.end() && progress->status == CheckStatus::warn;
  return {made.word, tightest == nullptr ? kNone : tightest->margin, summary.speed, weakest(made), still, true};
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

/// True if all parts with this check have the same rating.
bool same_ratings(const Scenario& scenario, const RemedySettings& settings, const CheckKind& kind) {
  constexpr std::pair<std::string_view, DockQuantity> kDocks[] = {{"dock_tension", DockQuantity::tension},
                                                                  {"dock_shear", DockQuantity::shear},
                                                                  {"dock_bending", DockQuantity::bending},
                                                                  {"dock_torsion", DockQuantity::torsion}};
  for (const auto& [id, quantity] : kDocks) {
    if (id != kind.id) continue;
    std::vector<double> limits = dock_limits(*scenario.robot, quantity);
    std::erase_if(limits, [](double limit) { return std::isnan(limit); });
    return std::ranges::adjacent_find(limits, std::ranges::not_equal_to()) == limits.end();
  }
  return settings.uniform(kind.key);
}

struct Stopped {};

class Search {
 public:
  Search(const RemedyTask& task, std::atomic<bool>& stop)
      : task_(task), stop_(stop), made_{RemedySettings(resolved(task.scenario)), hash(resolved(task.scenario))} {
    made_.word = task.verdict.word;
    made_.engine = made_.own_engine = task.scenario.physics.engine->name;
  }

  Remedy made() {
    add_ratings();
    for (const RemedyKey& key : remedy_keys()) {
      if (!task_.by.empty() && std::ranges::count(task_.by, key.name) == 0) continue;
      if (const std::string reason = made_.settings.missing(key); !reason.empty()) {
        made_.lacking.push_back({&key, reason});
      } else {
        for (const bool up : {false, true}) made_.answers.push_back({.key = &key, .up = up});
      }
    }
    expected_ = static_cast<double>(made_.answers.size()) * (kPointsEachWay + kRunsPerAnswer) + (task_.map ? cells() : 0);
    choose_engine();
    find_brackets();
    narrow();
    confirm();
    const bool helps = std::ranges::any_of(made_.answers, &RemedyAnswer::confirmed);
    const bool grid = made_.settings.missing(key("frequency")).empty() && made_.settings.missing(key("amplitude")).empty();
    const bool pairs = grid && !feasible() && !helps && task_.by.empty() && !made_.ratings_suffice;
    if (grid && (pairs || task_.map)) draw_map();
    if (pairs) find_pair();
    return std::move(made_);
  }

 private:
  /// Interval of factors at whose ends the verdicts differ.
  struct Bracket {
    RemedyAnswer* answer;
    double inner, outer;
    [[nodiscard]] bool wide() const { return std::abs(outer - inner) > std::max(kNarrowest, kTolerance * std::abs(outer - 1)); }
    [[nodiscard]] double at(int cut) const { return inner + (outer - inner) * cut / (kCuts + 1); }
  };

  [[nodiscard]] bool feasible() const { return made_.word == Word::feasible; }
  static double cells() { return std::pow(2 * kMapEachWay + 1, 2); }
  static const RemedyKey& key(const std::string& name) {
    return *std::ranges::find_if(remedy_keys(), [&](const RemedyKey& k) { return k.name == name; });
  }

  [[nodiscard]] std::vector<std::string> sets(const Change& change) const {
    std::vector<std::string> all;
    for (const auto& [key, factor] : change) {
      for (std::string& set : made_.settings.scaled(*key, factor)) all.push_back(std::move(set));
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
        results[i] = refused(error.problems());
        continue;
      }
      if (!confirming) {
        scenarios.back().physics.estimate = Estimate::off;
        scenarios.back().physics.estimated_by_others = true;
      }
      numbers.push_back(i);
    }
    const auto judge = [&](std::size_t k, RolloutEnd&& end) {
      results[numbers[k]] = end.refused.empty() ? judged(scenarios[k], end.recording) : refused(end.refused);
      const double done = done_.fetch_add(1) + 1;
      if (task_.progress) task_.progress(std::min(0.99, done / expected_));
    };
    run_all(scenarios, task_.batch, kVerdictReads, stop_, judge);
    if (stop_) throw Stopped{};
    made_.runs += scenarios.size();
    return results;
  }

  static RemedyRun refused(const std::vector<Problem>& problems) {
    return {.margin = kNone, .speed = kNone, .refused = problems.front().text};
  }

  /// Takes engine `articulated` for the search if it can run the scenario and has the same verdict on the run itself.
  void choose_engine() {
    const char* const fast = "articulated";
    if (made_.own_engine == fast) return;
    faster_ = {std::string("physics.engine=") + fast, "physics.integrator=adaptive", "physics.step=auto",
               "physics.accuracy=0.01"};
    const RemedyRun same = run({Change{}}, false).front();
    if (same.refused.empty() && same.feasible() == feasible()) {
      made_.engine = fast;
    } else {
      faster_.clear();
    }
  }

  void add_ratings() {
    made_.ratings_suffice = made_.word == Word::infeasible;
    for (const Check& check : task_.verdict.checks) {
      if (check.status != CheckStatus::fail && check.status != CheckStatus::too_close) continue;
      const auto kind = std::ranges::find_if(check_kinds(), [&](const CheckKind& k) { return k.id == check.id; });
      if (!kind->rating) {
        made_.ratings_suffice = false;
        continue;
      }
      const std::string path = kind->key;
      made_.ratings.push_back({check.id, check.worst, path.substr(path.rfind('.') + 1),
                               rounded(check.value * (1 + check.error), 0, true), check.limit, check.unit, check.parts,
                               same_ratings(task_.scenario, made_.settings, *kind)});
    }
  }

  /// Tries the geometric points of every setting, and finds the first change of the verdict in each direction.
  void find_brackets() {
    const double step = std::pow(kFarthest, 2.0 / (2 * kPointsEachWay - 1));
    std::vector<Change> changes;
    for (const RemedyAnswer& answer : made_.answers) {
      for (int k = 0; k < kPointsEachWay; ++k)
        changes.push_back({{answer.key, std::pow(step, (answer.up ? 1 : -1) * (k + 0.5))}});
    }
    const std::vector<RemedyRun> runs = run(changes, false);
    for (std::size_t a = 0; a < made_.answers.size(); ++a) {
      for (std::size_t k = a * kPointsEachWay; k < (a + 1) * kPointsEachWay; ++k) {
        if (!extends(made_.answers[a], changes[k].front().second, runs[k])) break;
      }
    }
  }

  /// Takes the next point outwards. Returns false if no further point matters.
  bool extends(RemedyAnswer& answer, double factor, const RemedyRun& tried) {
    if (!tried.refused.empty()) {
      answer.refused = tried.refused;
      answer.refused_at = factor;
      return false;
    }
    const bool other = tried.feasible() != feasible();
    if (answer.crosses && !other) return false;
    if (other && !answer.crosses) {
      answer.crosses = true;
      brackets_.push_back({&answer, answer.until, factor});
      if (feasible()) {
        answer.beyond = tried;
        return false;
      }
    }
    answer.until = factor;
    return true;
  }

  void narrow() {
    for (;;) {
      std::vector<Bracket*> wide;
      std::vector<Change> changes;
      for (Bracket& bracket : brackets_) {
        if (!bracket.wide()) continue;
        wide.push_back(&bracket);
        for (int k = 1; k <= kCuts; ++k) changes.push_back({{bracket.answer->key, bracket.at(k)}});
      }
      if (wide.empty()) return;
      const std::vector<RemedyRun> runs = run(changes, false);
      for (std::size_t b = 0; b < wide.size(); ++b) shrink(*wide[b], &runs[b * kCuts]);
    }
  }

  /// Takes the runs of the interior points of a bracket, from inside to outside.
  void shrink(Bracket& bracket, const RemedyRun* runs) const {
    const Bracket old = bracket;
    for (int k = 1; k <= kCuts; ++k, ++runs) {
      if (runs->feasible() == feasible()) {
        bracket.inner = old.at(k);
        continue;
      }
      bracket.outer = old.at(k);
      if (feasible()) bracket.answer->beyond = *runs;
      return;
    }
  }

  /// The factor with a rounded value, on the safe side: farther from 1, or nearer to 1 for a feasible gait.
  [[nodiscard]] double safe(const RemedyAnswer& answer, double factor) const {
    const double now = made_.settings.value(*answer.key);
    const bool up = answer.up != feasible();
    return std::isnan(now) ? rounded(factor, 1, up) : rounded(now * factor, now, up) / now;
  }

  void confirm() {
    std::vector<RemedyAnswer*> open;
    for (const Bracket& bracket : brackets_) {
      RemedyAnswer& answer = *bracket.answer;
      answer.factor = safe(answer, feasible() ? bracket.inner : bracket.outer);
      if (answer.factor != 1) open.push_back(&answer);
    }
    std::map<const RemedyAnswer*, RemedyAnswer> first;  // answers after the first round
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
        const double next = next_factor(*open[a], runs[at], !feasible() && runs[at + 1].feasible());
        first.try_emplace(open[a], *open[a]);
        if (next == open[a]->factor) continue;
        open[a]->factor = next;
        still.push_back(open[a]);
      }
      open = std::move(still);
    }
    for (RemedyAnswer& answer : made_.answers) {
      if (!answer.crosses) continue;
      if (const auto tried = first.find(&answer); !answer.confirmed && tried != first.end()) answer = tried->second;
      answer.sets = made_.settings.scaled(*answer.key, answer.factor);
      if (feasible() || std::abs(answer.until - 1) < std::abs(answer.factor - 1)) answer.until = answer.factor;
    }
  }

  /// Takes the result of a confirming run. Returns the next factor to try, or the same factor if the answer is final.
  [[nodiscard]] double next_factor(RemedyAnswer& answer, const RemedyRun& with, bool less_suffices) const {
    answer.run = with;
    answer.less_suffices = with.feasible() && less_suffices;
    answer.confirmed = with.feasible() && !less_suffices;
    if (answer.confirmed) return answer.factor;
    const bool inwards = feasible() || with.feasible();
    const double next = inwards ? 1 + kLess * (answer.factor - 1) : std::pow(answer.factor, kMore);
    const double rounded = safe(answer, std::clamp(next, 1 / kFarthest, kFarthest));
    return rounded == 1 ? answer.factor : rounded;
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
      if (!pair.run.feasible()) continue;
      pair.sets = sets(change);
      made_.pair = std::move(pair);
      return;
    }
  }

  const RemedyTask& task_;
  std::atomic<bool>& stop_;
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
  } catch (const Stopped&) {
    return {};
  }
}

}  // namespace gaitlab::report
