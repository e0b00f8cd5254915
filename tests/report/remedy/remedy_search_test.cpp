// Decisions of the search for a remedy. The test prescribes the verdict of each change of the settings, so that no search waits
// for a gait: every run is that of one light arm without gravity, with a limit that makes it feasible or infeasible.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>

#include "report/analysis/collisions.h"
#include "report/remedy/remedy.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using report::Remedy;
using report::RemedyAnswer;
using Sets = std::vector<std::string>;

enum class Outcome { feasible, infeasible, without_estimate, refused };

struct Prescribed {
  Outcome outcome = Outcome::infeasible;
  double speed = 0;  ///< m/s
  friend auto operator<=>(const Prescribed&, const Prescribed&) = default;
};

Prescribed feasible_if(bool feasible) { return {feasible ? Outcome::feasible : Outcome::infeasible}; }

const std::map<std::string, double> kNow{{"cpg.frequency", 4},  {"cpg.amplitude", 0.05}, {"actuator.u_max", 8},
                                         {"actuator.i_max", 2}, {"controller.Kp", 30},   {"ground.friction", 0.5}};

/// The arm, whose base flies at this speed.
Scenario arm(const std::string& engine, const Prescribed& prescribed) {
  return scenario(fmt::format(R"(gaitlab: 1
robot:
  base: planar
  modules:
    gaitlab_module: 1
    name: lever
    bodies:
      base: {{mass: 0.2, shape: [{{box: [0.05, 0.05, 0.05]}}]}}
      rod: {{mass: 0.05, com: [0, 0, -0.08], inertia: [1e-4, 1e-4, 1e-5, 0, 0, 0]}}
    hinges: [{{name: j, parent: base, child: rod, axis: [0, 1, 0], range: [-1.5, 1.5]}}]
initial: {{base_velocity: [{}, 0, 0]}}
physics: {{engine: {}, gravity: [0, 0, 0], estimate: {}}}
ground: {{friction: {}}}
contact: {{on: none}}
cpg: {{type: sine, frequency: {}, amplitude: {}}}
controller: {{type: pid, Kp: {}}}
actuator: {{type: servo, voltage: 8, stall_torque: 0.4, no_load_speed: 20, stall_current: 2, load_friction: 0,
  dry_friction: 0, viscous_friction: 0, rotor_inertia: 0, u_max: {}, i_max: {}}}
limits: {{tracking_error: {}}}
duration: 1
)",
                              prescribed.speed, engine, prescribed.outcome == Outcome::without_estimate ? "off" : "full",
                              kNow.at("ground.friction"), kNow.at("cpg.frequency"), kNow.at("cpg.amplitude"),
                              kNow.at("controller.Kp"), kNow.at("actuator.u_max"), kNow.at("actuator.i_max"),
                              prescribed.outcome == Outcome::infeasible ? 1e-9 : 100));
}

/// A change of settings that a search tries.
struct Tried {
  std::map<std::string, double> factors;  ///< by path; a path without an entry has the factor 1
  bool fast = false;                      ///< true for a run with the engine of the search instead of the scenario's
  [[nodiscard]] double operator()(const std::string& path) const {
    const auto at = factors.find(path);
    return at == factors.end() ? 1 : at->second;
  }
};

Tried tried(const Sets& sets) {
  Tried made;
  for (const std::string& set : sets) {
    const std::size_t equal = set.find('=');
    const std::string path = set.substr(0, equal);
    if (const auto now = kNow.find(path); now != kNow.end())
      made.factors[path] = std::stod(set.substr(equal + 1)) / now->second;
    made.fast = made.fast || set == "physics.engine=articulated";
  }
  return made;
}

using Rule = std::function<Prescribed(const Tried&)>;

/// Searches with the settings `by`, or all, for a scenario with this engine.
Remedy search(const Rule& rule, const Sets& by, const std::string& engine = "articulated") {
  const Prescribed own = rule({});
  const Scenario of_run = arm("articulated", own);
  const Recording record = run(of_run);
  const report::Verdict verdict =
      report::verdict(of_run, record, report::summarise(of_run, record, 0), report::overlaps(of_run, record));
  EXPECT_EQ(verdict.word, own.outcome == Outcome::feasible ? Word::feasible : Word::infeasible) << verdict.reason.text;
  std::map<Prescribed, Scenario> made;
  const auto with = [&](const Sets& sets) {
    const Prescribed of = rule(tried(sets));
    if (of.outcome == Outcome::refused) throw InputError(SourceLocation{"arm.yaml"}, "too large");
    if (!made.contains(of)) made.emplace(of, arm("articulated", of));
    return made.at(of);
  };
  std::atomic<bool> stop = false;
  return report::remedy({arm(engine, own), verdict, with, false, by, {}, {}}, stop);
}

/// Factors of a setting between which the verdict is that of the run.
struct Thresholds {
  const char *name, *path;
  double down, up;
};

/// Thresholds of six settings, on either side of the factors that every search tries (up: 1.26, 1.99, 3.16, 5).
const std::vector<Thresholds> kThresholds{
    {"frequency", "cpg.frequency", 0.95, 1.06}, {"amplitude", "cpg.amplitude", 0.6, 1.7},
    {"u_max", "actuator.u_max", 0.34, 2.63},    {"i_max", "actuator.i_max", 0.21, 4.9},
    {"Kp", "controller.Kp", 0.81, 3.3},         {"friction", "ground.friction", 0.45, 1.31}};

Sets threshold_names() {
  Sets all;
  for (const Thresholds& one : kThresholds) all.emplace_back(one.name);
  return all;
}

bool within_all(const Tried& change) {
  return std::ranges::all_of(kThresholds, [&](const Thresholds& one) {
    const double factor = change(one.path);
    return one.down < factor && factor < one.up;
  });
}

const Thresholds& thresholds_of(const RemedyAnswer& answer) {
  return *std::ranges::find_if(kThresholds, [&](const Thresholds& one) { return std::string(one.name) == answer.key->name; });
}

// The last bracket is as wide as 2 % of the change or 1e-3, and the value is rounded by at most a hundredth of the change.
constexpr double kBracket = 0.02, kNarrowest = 1e-3, kRounded = 0.01;

TEST(RemedySearch, FindsTheNearestFeasibleValueToTwoPercentOfTheChange) {
  const Rule rule = [](const Tried& change) { return feasible_if(!within_all(change)); };
  const Remedy made = search(rule, threshold_names());
  ASSERT_EQ(made.answers.size(), 2 * kThresholds.size());
  for (const RemedyAnswer& answer : made.answers) {
    const double end = answer.up ? thresholds_of(answer).up : thresholds_of(answer).down;
    const std::string what = fmt::format("{} at {}: {}", answer.key->name, end, answer.factor);
    EXPECT_TRUE(answer.crosses && answer.confirmed) << what;
    EXPECT_GE((answer.factor - end) * (answer.up ? 1 : -1), -1e-9) << what << " is infeasible";
    EXPECT_LE(std::abs(answer.factor - 1), (std::abs(end - 1) / (1 - kBracket) + kNarrowest) * (1 + kRounded)) << what;
    EXPECT_NEAR(answer.until, answer.up ? 5 : 0.2, 1e-9) << what;
    EXPECT_TRUE(answer.run.feasible()) << what;
    EXPECT_NEAR(tried(answer.sets)(thresholds_of(answer).path), answer.factor, 1e-9) << what;
  }
}

TEST(RemedySearch, FindsTheFarthestValueThatStaysFeasible) {
  const Remedy made = search([](const Tried& change) { return feasible_if(within_all(change)); }, threshold_names());
  ASSERT_EQ(made.answers.size(), 2 * kThresholds.size());
  for (const RemedyAnswer& answer : made.answers) {
    const double end = answer.up ? thresholds_of(answer).up : thresholds_of(answer).down;
    const std::string what = fmt::format("{} at {}: {}", answer.key->name, end, answer.factor);
    EXPECT_TRUE(answer.crosses && answer.confirmed) << what;
    EXPECT_GE((end - answer.factor) * (answer.up ? 1 : -1), -1e-9) << what << " is infeasible";
    EXPECT_GE(std::abs(answer.factor - 1), ((1 - kBracket) * std::abs(end - 1) - kNarrowest) * (1 - kRounded)) << what;
    EXPECT_EQ(answer.until, answer.factor) << what;
    EXPECT_TRUE(answer.run.feasible()) << what;
    EXPECT_TRUE(answer.beyond.simulated && !answer.beyond.feasible()) << what;
  }
}

/// The answer for larger currents if a run is feasible for these factors.
RemedyAnswer larger_current(const std::function<bool(double)>& feasible) {
  const Remedy made = search([&](const Tried& change) { return feasible_if(feasible(change("actuator.i_max"))); }, {"i_max"});
  EXPECT_FALSE(made.answers.front().crosses) << "no smaller current changes the verdict";
  EXPECT_NEAR(made.answers.front().until, 0.2, 1e-9);
  return made.answers.back();
}

TEST(RemedySearch, TakesTheNearestOfSeveralChanges) {
  // Between two of the first factors, 1.26 and 1.99, which bisection divides at 1.44, 1.62 and 1.81.
  const RemedyAnswer within = larger_current([](double i) { return (i >= 1.4 && i < 1.5) || i >= 1.7; });
  EXPECT_TRUE(within.confirmed);
  EXPECT_NEAR(within.factor, 1.4, 0.02);
  // Among the first factors: the answer holds up to 1.99, not to the 5 beyond the gap.
  const RemedyAnswer gap = larger_current([](double i) { return (i >= 1.5 && i < 2.2) || i >= 4; });
  EXPECT_TRUE(gap.confirmed);
  EXPECT_NEAR(gap.factor, 1.5, 0.02);
  EXPECT_NEAR(gap.until, std::pow(5, 3.0 / 7), 1e-9);
  const RemedyAnswer reserve = larger_current([](double i) { return i < 1.5 || i >= 3; });
  EXPECT_TRUE(reserve.confirmed);
  EXPECT_NEAR(reserve.factor, 1.5, 0.02);
}

TEST(RemedySearch, EndsWhereTheScenarioRefusesTheValue) {
  const Rule rule = [](const Tried& change) {
    return change("cpg.amplitude") > 2.5 ? Prescribed{Outcome::refused} : feasible_if(change("cpg.amplitude") < 0.5);
  };
  const Remedy made = search(rule, {"amplitude"});
  const RemedyAnswer &smaller = made.answers.front(), &larger = made.answers.back();
  EXPECT_TRUE(smaller.confirmed);
  EXPECT_TRUE(smaller.refused.empty());
  EXPECT_FALSE(larger.crosses);
  EXPECT_EQ(larger.refused, "too large");
  EXPECT_NEAR(larger.until, std::pow(5, 3.0 / 7), 1e-9);
  EXPECT_NEAR(larger.refused_at, std::pow(5, 5.0 / 7), 1e-9);
}

/// The answer for larger currents, which are feasible in the search from 1.6 times the present one on, and in engine `bullet`
/// as `own` says.
RemedyAnswer confirmed_by(const std::function<Prescribed(double)>& own) {
  const Rule rule = [&](const Tried& change) {
    const double current = change("actuator.i_max");
    return change.fast || current <= 1 ? feasible_if(current >= 1.6) : own(current);
  };
  const Remedy made = search(rule, {"i_max"}, "bullet");
  EXPECT_EQ(made.engine, "articulated");
  EXPECT_EQ(made.own_engine, "bullet");
  return made.answers.back();
}

TEST(RemedySearch, ItsAnswersHoldInTheEngineOfTheScenario) {
  for (const double from : {1.3, 1.45, 1.6, 1.75, 1.9}) {
    const RemedyAnswer answer = confirmed_by([from](double current) { return feasible_if(current >= from); });
    EXPECT_TRUE(answer.confirmed) << from;
    EXPECT_GE(answer.factor, from);
    EXPECT_LT(1 + 0.9 * (answer.factor - 1), from) << "nine tenths of the change must not suffice";
    EXPECT_TRUE(answer.run.feasible()) << from;
  }
}

// The answer of the search, with the run that does not confirm it.
TEST(RemedySearch, AnAnswerThatNoRunConfirmsIsNotConfirmed) {
  const RemedyAnswer never = confirmed_by([](double) { return feasible_if(false); });
  EXPECT_FALSE(never.confirmed || never.less_suffices);
  EXPECT_NEAR(never.factor, 1.6, 0.02);
  EXPECT_EQ(never.run.word, Word::infeasible);
  const RemedyAnswer always = confirmed_by([](double) { return feasible_if(true); });
  EXPECT_FALSE(always.confirmed);
  EXPECT_TRUE(always.less_suffices);
  EXPECT_NEAR(always.factor, 1.6, 0.02);
  // Runs of the search need no estimate of the torque error, those that confirm an answer do.
  const RemedyAnswer unknown = confirmed_by([](double) { return Prescribed{Outcome::without_estimate}; });
  EXPECT_FALSE(unknown.confirmed);
  EXPECT_EQ(unknown.run.word, Word::not_judged);
}

/// Frequency and amplitude help only together. The fastest pair of the search is infeasible in the engine of the scenario.
Prescribed only_together(const Tried& change) {
  const double frequency = change("cpg.frequency"), amplitude = change("cpg.amplitude");
  const bool fastest = frequency > 0.4 && frequency < 0.5 && amplitude > 0.5 && amplitude < 0.6;
  const bool second = frequency > 0.3 && frequency < 0.4 && amplitude > 0.5 && amplitude < 0.6;
  if (!(frequency < 0.5 && amplitude < 0.6) || (fastest && !change.fast)) return feasible_if(false);
  return {Outcome::feasible, fastest ? 0.3 : second ? 0.2 : 0.1};
}

TEST(RemedySearch, TakesTheFastestFeasiblePairIfNoSettingAloneHelps) {
  const Remedy made = search(only_together, {}, "bullet");
  ASSERT_TRUE(made.pair);
  EXPECT_NEAR(made.pair->frequency, std::pow(5, -4.0 / 6), 1e-9);
  EXPECT_NEAR(made.pair->amplitude, std::pow(5, -2.0 / 6), 1e-9);
  EXPECT_TRUE(made.pair->run.feasible());
  EXPECT_NEAR(made.pair->run.speed, 0.2, 0.01);  // the rod moves the base
  const Tried sets = tried(made.pair->sets);
  EXPECT_NEAR(sets("cpg.frequency"), made.pair->frequency, 1e-9);
  EXPECT_NEAR(sets("cpg.amplitude"), made.pair->amplitude, 1e-9);
  ASSERT_TRUE(made.map);
  for (std::size_t k = 0; k < made.map->runs.size(); ++k) {
    const double amplitude = made.map->factors[k / made.map->factors.size()];
    const double frequency = made.map->factors[k % made.map->factors.size()];
    EXPECT_EQ(made.map->runs[k].feasible(), frequency < 0.5 && amplitude < 0.6) << "a row per amplitude";
  }
}

TEST(RemedySearch, TakesNoPairIfASettingHelpsOrIfOnlySomeAreAskedFor) {
  const Remedy alone = search([](const Tried& change) { return feasible_if(change("controller.Kp") > 2); }, {});
  EXPECT_FALSE(alone.pair || alone.map);
  const Remedy asked = search(only_together, {"frequency", "amplitude"}, "bullet");
  EXPECT_FALSE(asked.pair || asked.map);
}

}  // namespace
}  // namespace gaitlab::test
