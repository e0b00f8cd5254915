// Numbers of a resolved scenario multiplied by key: scalars, maps by joint, lists, boxes, keys that are missing or change in
// time. The engine of a search.
#include "report/remedy/remedy.h"

#include <cmath>

#include "core/scenario/resolved.h"
#include "report/analysis/collisions.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using report::remedy_keys;
using report::RemedyKey;
using report::RemedySettings;

const RemedyKey& remedy_key(const std::string& name) {
  for (const RemedyKey& key : remedy_keys()) {
    if (key.name == name) return key;
  }
  throw std::invalid_argument(name);
}

using Sets = std::vector<std::string>;

TEST(RemedySettings, MultipliesNumbersWhereTheyStand) {
  const RemedySettings settings(
      "cpg: {frequency: 0.25, amplitude: {default: 0.5, \"*/gamma\": 0, m3/active: 0.2}}\n"
      "actuator: {u_max: 7.4, i_max: [1.2, 0.6], type: dc_motor}\nduration: 20\n");
  EXPECT_EQ(settings.scaled(remedy_key("u_max"), 0.5), Sets{"actuator.u_max=3.7"});
  EXPECT_EQ(settings.scaled(remedy_key("amplitude"), 2),
            Sets{"cpg.amplitude={\"default\": 1, \"*/gamma\": 0, \"m3/active\": 0.4}"});
  EXPECT_EQ(settings.scaled(remedy_key("u_max with i_max"), 2), (Sets{"actuator.u_max=14.8", "actuator.i_max=[2.4, 1.2]"}));
  EXPECT_EQ(settings.value(remedy_key("frequency")), 0.25);
  EXPECT_TRUE(std::isnan(settings.value(remedy_key("amplitude"))));
  EXPECT_TRUE(std::isnan(settings.value(remedy_key("u_max with i_max"))));
}

TEST(RemedySettings, ASlowerGaitIsRunForLonger) {
  const RemedySettings settings("cpg: {frequency: 0.25}\nduration: 20\n");
  EXPECT_EQ(settings.scaled(remedy_key("frequency"), 0.5), (Sets{"cpg.frequency=0.125", "duration=40"}));
  EXPECT_EQ(settings.scaled(remedy_key("frequency"), 0.3), (Sets{"cpg.frequency=0.075", "duration=66.667"}));
  EXPECT_EQ(settings.scaled(remedy_key("frequency"), 2), Sets{"cpg.frequency=0.5"});
}

TEST(RemedySettings, AKeyWithoutNumbersIsMissing) {
  const RemedySettings settings("cpg: {type: table, amplitude: {default: 0}}\nactuator: {u_max: 0, i_max: 1}\nduration: 1\n");
  for (const char* name : {"frequency", "amplitude", "u_max", "u_max with i_max", "friction"})
    EXPECT_EQ(settings.missing(remedy_key(name)), "missing or 0") << name;
  EXPECT_EQ(settings.missing(remedy_key("i_max")), "");
}

TEST(RemedySettings, AKeyThatChangesDuringTheRunIsLeftOut) {
  const RemedySettings settings(
      "cpg: {frequency: 1, amplitude: 0.5}\ncontroller: {Kp: 100}\nduration: 9\n"
      "at:\n  - {t: 3, set: {cpg.amplitude: 0.3}}\n  - {t: 4, set: {controller.Kp.m3/active: 80}}\n  - {t: 5, fault: {joint: "
      "m3/active, kind: dead}}\n");
  EXPECT_EQ(settings.missing(remedy_key("amplitude")), "set by `at`");
  EXPECT_EQ(settings.missing(remedy_key("Kp")), "set by `at`");
  EXPECT_EQ(settings.missing(remedy_key("frequency")), "");
}

TEST(RemedySettings, FrictionIsThatOfBoxesToo) {
  const RemedySettings settings(
      "ground: {friction: 0.5, boxes: [{center: [1, 2, 3], friction: 0.4, mass: 0}, {center: [0, 0, 1], friction: 0.8}]}\n");
  EXPECT_EQ(settings.scaled(remedy_key("friction"), 2),
            (Sets{"ground.friction=1",
                  "ground.boxes=[{\"center\": [1, 2, 3], \"friction\": 0.8, \"mass\": 0}, {\"center\": [0, 0, "
                  "1], \"friction\": 1.6}]"}));
}

// The settings of an answer mean the same for the user's file and for the resolved scenario, which the search reads.
TEST(RemedySettings, MeanTheSameForTheFileAndTheResolvedScenario) {
  const Folder folder;
  for (const char* file :
       {"caterpillar.yaml", "hexapod.yaml", "rubble.yaml", "library/rofi-snake.yaml", "library/dtto-caterpillar.yaml"}) {
    const std::vector<std::string> own{"duration=1"};
    const std::string text = resolved(shipped(file, own));
    folder.write("resolved.yaml", text);
    const RemedySettings settings(text);
    for (const RemedyKey& key : remedy_keys()) {
      if (!settings.missing(key).empty()) continue;
      std::vector<std::string> sets = settings.scaled(key, 1.1);
      const std::string of_record = resolved(read_scenario(folder / "resolved.yaml", sets, catalog(), ReadAs::record));
      sets.insert(sets.begin(), own.begin(), own.end());
      EXPECT_EQ(resolved(shipped(file, sets)), of_record) << file << " " << key.name;
    }
  }
}

/// Two modules in engine bullet, whose heating currents are far below their rating of 1 A.
const std::string kTwoInBullet = R"(gaitlab: 1
robot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}
physics: {engine: bullet, step: 5e-5}
contact: {on: all}
cpg: {type: sine, frequency: 5, amplitude: 0.03, phase_lag: 1.2}
actuator: {i_continuous: 1}
trace: {period: 0.05}
duration: 0.8
)";

/// Engine of the search for a scenario in engine bullet; under engine articulated it also has the settings `other`. No setting
/// is tried, so that the only run of the search is the one that compares the engines.
std::string engine_of_search(const Sets& own, const Sets& other, report::Word word) {
  const Scenario s = scenario(kTwoInBullet, own);
  const Recording record = run(s);
  const report::Verdict verdict = report::verdict(s, record, report::summarise(s, record, 0), report::overlaps(s, record));
  EXPECT_EQ(verdict.word, word) << verdict.reason << verdict.why();
  const auto with = [&](const Sets& sets) {
    Sets all = own;
    all.insert(all.end(), sets.begin(), sets.end());
    if (std::ranges::count(sets, "physics.engine=articulated") > 0) all.insert(all.end(), other.begin(), other.end());
    return scenario(kTwoInBullet, all);
  };
  std::atomic<bool> stop = false;
  const report::Remedy made = report::remedy({s, verdict, with, false, {"none"}, {}, {}}, stop);
  EXPECT_EQ(made.runs, 1U);
  EXPECT_EQ(made.own_engine, "bullet");
  return made.engine;
}

TEST(RemedyEngine, IsTheFasterOneWhereTheVerdictsAgree) {
  EXPECT_EQ(engine_of_search({}, {}, report::Word::feasible), "articulated");
  const Sets weak{"actuator.i_continuous=0.001"};
  EXPECT_EQ(engine_of_search(weak, {}, report::Word::infeasible), "articulated");
}

TEST(RemedyEngine, IsThatOfTheScenarioWhereTheVerdictsDiffer) {
  const Sets weak{"actuator.i_continuous=0.001"}, strong{"actuator.i_continuous=1"};
  EXPECT_EQ(engine_of_search({}, weak, report::Word::feasible), "bullet");
  EXPECT_EQ(engine_of_search(weak, strong, report::Word::infeasible), "bullet");
}

}  // namespace
}  // namespace gaitlab::test
