#include "report/remedy/remedy.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

#include "core/files/hash.h"
#include "core/scenario/resolved.h"
#include "report/remedy/finer_remedy.h"
#include "report/remedy/remedy_work.h"

namespace gaitlab::report {

namespace {

constexpr double kFarthest = 5;        // largest factor; its inverse is the smallest
constexpr int kPointsEachWay = 4;      // factors of a setting in each direction, evenly spaced in their logarithm
constexpr int kCuts = 3;               // interior points of a bracket that are tried at once
constexpr double kTolerance = 0.02;    // width of the last bracket, as a share of the change
constexpr double kLess = 0.9;          // share of the change that must not suffice
constexpr double kNarrowest = 1e-3;    // least width of a bracket, for changes close to the present value
constexpr double kMore = 1.08;         // factor on the logarithm of a change that does not suffice
constexpr int kMostRounds = 8;         // attempts to confirm an answer
constexpr int kMapEachWay = 6;         // cells of the map on either side of the run
constexpr std::size_t kMostPairs = 5;  // pairs to confirm, the fastest first
// Only for the estimate of the work: number of rounds that confirm an answer, and ratios of the computing times of a simulated
// second in these rounds and in the search. The rounds use another engine and the estimate, or only add the estimate.
constexpr double kLikelyRounds = 1.5, kEngineRatio = 8, kEstimateRatio = 2;
constexpr const char* kFastEngine = "articulated";

/// Settings multiplied together, each by a factor.
using Change = std::vector<std::pair<const RemedyKey*, double>>;

struct Stopped {};

class RemedySearch {
 public:
  RemedySearch(const RemedyTask& task, std::atomic<bool>& stop)
      : task_(task),
        stop_(stop),
        made_{settings_of(task.scenario), hash(resolved(task.scenario))},
        work_(task.scenario.physics.engine->name == kFastEngine ? kEstimateRatio : kEngineRatio) {
    made_.word = task.verdict.word;
    made_.engine = made_.own_engine = task.scenario.physics.engine->name;
  }

  Remedy made() {
    made_.ratings = ratings_needed(task_.scenario, task_.verdict, made_.settings);
    made_.ratings_suffice = made_.word == Word::infeasible && only_ratings(task_.verdict);
    for (const RemedyKey& key : remedy_keys()) {
      if (!task_.by.empty() && std::ranges::count(task_.by, key.name) == 0) continue;
      if (const std::string reason = made_.settings.missing(key); !reason.empty()) {
        if (!task_.by.empty() || made_.settings.concerns(key)) made_.lacking.push_back({&key, reason});
      } else {
        for (const bool up : {false, true}) made_.answers.push_back({.key = &key, .up = up, .stopped = true});
      }
    }
    try {
      search();
    } catch (const Stopped&) {
      made_.interrupted = true;
      if (first_.empty()) (void)placed();
      settle();
    }
    return std::move(made_);
  }

 private:
  /// Interval of factors at whose ends the verdicts differ.
  struct Bracket {
    RemedyAnswer* answer;
    double inner, outer;
    [[nodiscard]] bool wide() const { return std::abs(outer - inner) > std::max(kNarrowest, kTolerance * std::abs(outer - 1)); }
    /// Number of rounds until the bracket is narrow.
    [[nodiscard]] double rounds() const {
      const double narrow = std::max(kNarrowest, kTolerance * std::abs(outer - 1));
      return std::max(0.0, std::ceil(std::log2(std::abs(outer - inner) / narrow) / std::log2(kCuts + 1)));
    }
    [[nodiscard]] double at(int cut) const { return inner + (outer - inner) * cut / (kCuts + 1); }
  };

  void search() {
    choose_engine();
    find_brackets();
    narrow();
    confirm();
    settle();
    const bool helps = std::ranges::any_of(made_.answers, &RemedyAnswer::confirmed);
    const bool pairs = pairs_matter() && !helps;
    if (grid() && (pairs || task_.map)) draw_map();
    if (pairs) find_pair();
  }

  [[nodiscard]] bool feasible() const { return made_.word == Word::feasible; }
  /// True if the scenario has both settings of the map.
  [[nodiscard]] bool grid() const {
    return made_.settings.missing(key("frequency")).empty() && made_.settings.missing(key("amplitude")).empty();
  }
  /// True if a pair of frequency and amplitude is to be searched when no setting alone helps.
  [[nodiscard]] bool pairs_matter() const { return grid() && !feasible() && task_.by.empty() && !made_.ratings_suffice; }
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

  /// Runs with the changes. `confirming` runs have the engine, step and estimate of the scenario. If the search is stopped,
  /// only the runs that have ended are known. `after` is the simulated time that the search is expected to take afterwards.
  std::vector<RemedyRun> run(const std::vector<Change>& changes, bool confirming, RemedyWork::Simulated after) {
    std::vector<RemedyRun> results(changes.size());
    std::vector<Scenario> scenarios;
    std::vector<std::size_t> numbers;
    double& of_these = after[confirming ? 1 : 0];
    for (std::size_t i = 0; i < changes.size(); ++i) {
      std::vector<std::string> all = sets(changes[i]);
      if (!confirming) all.insert(all.begin(), faster_.begin(), faster_.end());
      try {
        scenarios.push_back(task_.with(all));
      } catch (const InputError& error) {
        results[i] = refused_run(error.problems());
        continue;
      }
      if (!confirming) {
        scenarios.back().physics.estimate = Estimate::off;
        scenarios.back().physics.estimated_by_others = true;
      }
      of_these += scenarios.back().duration;
      numbers.push_back(i);
    }
    const auto judge = [&](std::size_t k, RolloutEnd&& end) {
      results[numbers[k]] = end.refused.empty() ? judged(scenarios[k], end.recording) : refused_run(end.refused);
      const double share = work_.ended(scenarios[k].duration);
      if (task_.progress) task_.progress(std::min(0.99, share));
    };
    work_.begin(confirming ? RemedyRuns::confirming : RemedyRuns::search, after, std::chrono::steady_clock::now());
    run_all(scenarios, task_.batch, kVerdictReads, stop_, judge);
    work_.end(std::chrono::steady_clock::now());
    for (const std::size_t i : numbers) made_.runs += results[i].known() ? 1 : 0;
    return results;
  }

  void end_if_stopped() const {
    if (stop_) throw Stopped{};
  }

  /// Expected simulated time after this round, of the search in the brackets and of the confirming runs. If `half`, half of the
  /// answers are expected to get a bracket later.
  [[nodiscard]] RemedyWork::Simulated of_brackets(bool half) const {
    RemedyWork::Simulated time{};
    const auto add = [&](const RemedyAnswer& answer, double share, double factor, double rounds) {
      const double each = share * task_.scenario.duration / (answer.key->stretches ? std::min(1.0, factor) : 1);
      time[0] += rounds * kCuts * each;
      time[1] += kLikelyRounds * (feasible() ? 1 : 2) * each;
    };
    for (const Bracket& bracket : brackets_) add(*bracket.answer, 1, bracket.outer, bracket.rounds() - 1);
    constexpr double kHalf = 0.5, kRounds = 3;  // three rounds divide a bracket by 64
    if (!half) return time;
    for (const RemedyAnswer& answer : made_.answers) add(answer, kHalf, answer.up ? 1 : kHalf, kRounds);
    return time;
  }

  /// Expected simulated time of the map.
  [[nodiscard]] double of_map(bool pairs) const {
    if (!grid() || !(task_.map || (pairs && pairs_matter()))) return 0;
    double time = 0;
    for (const double frequency : map_factors()) time += task_.scenario.duration / std::min(1.0, frequency);
    return time * static_cast<double>(map_factors().size());
  }

  static std::vector<double> map_factors() {
    std::vector<double> factors;
    for (int k = -kMapEachWay; k <= kMapEachWay; ++k) factors.push_back(std::pow(kFarthest, k / double{kMapEachWay}));
    return factors;
  }

  /// Selects the engine `articulated` for the search if it can run the scenario and gives the same verdict on the run itself.
  void choose_engine() {
    if (made_.own_engine == kFastEngine) return;
    faster_ = {std::string("physics.engine=") + kFastEngine, "physics.integrator=adaptive", "physics.step=auto",
               "physics.accuracy=0.01"};
    RemedyWork::Simulated after = of_brackets(true);
    after[0] += of_map(false) + kPointsEachWay * task_.scenario.duration * static_cast<double>(made_.answers.size());
    const RemedyRun same = run({Change{}}, false, after).front();
    end_if_stopped();
    if (same.refused.empty() && same.feasible() == feasible()) {
      made_.engine = kFastEngine;
    } else {
      faster_.clear();
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
    RemedyWork::Simulated after = of_brackets(true);
    after[0] += of_map(false);
    const std::vector<RemedyRun> runs = run(changes, false, after);
    for (std::size_t a = 0; a < made_.answers.size(); ++a) {
      RemedyAnswer& answer = made_.answers[a];
      std::size_t k = a * kPointsEachWay;
      const std::size_t end = k + kPointsEachWay;
      while (k < end && runs[k].known() && extends(answer, changes[k].front().second, runs[k])) ++k;
      answer.stopped = answer.crosses || (k < end && !runs[k].known());
    }
    end_if_stopped();
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
      RemedyWork::Simulated after = of_brackets(false);
      after[0] += of_map(brackets_.empty());
      const std::vector<RemedyRun> runs = run(changes, false, after);
      for (std::size_t b = 0; b < wide.size(); ++b) shrink(*wide[b], &runs[b * kCuts]);
      end_if_stopped();
    }
  }

  /// Narrows a bracket by the runs at its interior points, which are given from inside to outside.
  void shrink(Bracket& bracket, const RemedyRun* runs) const {
    const Bracket old = bracket;
    for (int k = 1; k <= kCuts && runs->known(); ++k, ++runs) {
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
    return std::isnan(now) ? rounded_setting(factor, 1, up) : rounded_setting(now * factor, now, up) / now;
  }

  /// Sets the factors of the answers from the brackets. Returns the answers that runs can confirm.
  std::vector<RemedyAnswer*> placed() {
    std::vector<RemedyAnswer*> open;
    for (const Bracket& bracket : brackets_) {
      RemedyAnswer& answer = *bracket.answer;
      answer.factor = safe(answer, feasible() ? bracket.inner : bracket.outer);
      if (answer.factor != 1) open.push_back(&answer);
    }
    return open;
  }

  void confirm() {
    std::vector<RemedyAnswer*> open = placed();
    for (int round = 0; round < kMostRounds && !open.empty(); ++round) {
      std::vector<Change> changes;
      for (const RemedyAnswer* answer : open) {
        changes.push_back({{answer->key, answer->factor}});
        if (!feasible()) changes.push_back({{answer->key, 1 + kLess * (answer->factor - 1)}});
      }
      const std::vector<RemedyRun> runs = run(changes, true, {of_map(brackets_.empty()), 0});
      std::vector<RemedyAnswer*> still;
      for (std::size_t a = 0; a < open.size(); ++a) {
        const std::size_t at = feasible() ? a : 2 * a;
        if (!runs[at].known() || (!feasible() && !runs[at + 1].known())) continue;
        const double next = next_factor(*open[a], runs[at], !feasible() && runs[at + 1].feasible());
        first_.try_emplace(open[a], *open[a]);
        if (next == open[a]->factor) continue;
        open[a]->factor = next;
        still.push_back(open[a]);
      }
      open = std::move(still);
      end_if_stopped();
    }
    for (RemedyAnswer& answer : made_.answers) answer.stopped = false;
  }

  /// Restores the result of the first round in answers that no round has confirmed, and sets the settings of all answers.
  void settle() {
    for (RemedyAnswer& answer : made_.answers) {
      if (!answer.crosses) continue;
      const bool stopped = answer.stopped && !answer.confirmed;
      if (const auto tried = first_.find(&answer); !answer.confirmed && tried != first_.end()) answer = tried->second;
      answer.stopped = stopped;
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
    RemedyMap map{map_factors(), {}};
    std::vector<Change> changes;
    for (const double amplitude : map.factors) {
      for (const double frequency : map.factors)
        changes.push_back({{&key("frequency"), frequency}, {&key("amplitude"), amplitude}});
    }
    map.runs = run(changes, false, {0, pairs_matter() ? task_.scenario.duration : 0});
    end_if_stopped();
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
      pair.run = run({change}, true, {}).front();
      end_if_stopped();
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
  std::map<const RemedyAnswer*, RemedyAnswer> first_;  ///< answers after the first round of confirming runs
  Remedy made_;
  RemedyWork work_;
};

}  // namespace

Remedy remedy(const RemedyTask& task, std::atomic<bool>& stop) {
  if (task.verdict.word != Word::not_judged) return RemedySearch(task, stop).made();
  if (!task.verdict.retry_is_finer) throw no_verdict(task);
  return remedy_of_finer_run(task, stop);
}

}  // namespace gaitlab::report
