// Tests of the numbers of a resolved scenario that are multiplied by key (scalars, maps by joint, lists, boxes, missing keys,
// keys that change in time), and of the engine of a search.
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

/// A u_max of 0 means the voltage of the servo, per joint.
TEST(RemedySettings, ASupplyOfZeroIsTheVoltageOfTheServo) {
  const auto tripled = [](const std::string& actuator) {
    const RemedySettings settings("actuator: {" + actuator + "}\n");
    EXPECT_EQ(settings.missing(remedy_key("u_max")), "") << actuator;
    return settings.scaled(remedy_key("u_max"), 3);
  };
  EXPECT_EQ(tripled("voltage: 6, u_max: 0"), Sets{"actuator.u_max=18"});
  EXPECT_EQ(tripled("voltage: 6"), Sets{"actuator.u_max=18"});
  EXPECT_EQ(tripled("voltage: 6, u_max: 5"), Sets{"actuator.u_max=15"});
  EXPECT_EQ(tripled("voltage: [6, 7.4], u_max: 0"), Sets{"actuator.u_max=[18, 22.2]"});
  EXPECT_EQ(tripled("voltage: [6, 7.4], u_max: [5, 0]"), Sets{"actuator.u_max=[15, 22.2]"});
  EXPECT_EQ(tripled("voltage: 6, u_max: [0, 8]"), Sets{"actuator.u_max=[18, 24]"});
  const RemedySettings settings(
      "actuator: {voltage: 6, stall_torque: 1, no_load_speed: 5, stall_current: 2, u_max: 0, i_max: 0}\n");
  EXPECT_EQ(settings.value(remedy_key("u_max")), 6);
  EXPECT_EQ(settings.missing(remedy_key("i_max")), "0: the stall current at `voltage`");
  EXPECT_EQ(settings.scaled(remedy_key("no_load_speed"), 2), (Sets{"actuator.no_load_speed=10", "actuator.stall_current=4"}))
      << "a motor of this torque that is twice as fast draws twice the current";
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

/// The position gain has the key that the controller declares.
TEST(RemedySettings, TheGainIsThatOfTheController) {
  const auto doubled = [](const std::string& controller) {
    const Scenario s = scenario("gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 1\ncontroller: {" +
                                controller + "}\n");
    const RemedySettings settings = report::settings_of(s);
    EXPECT_EQ(settings.missing(remedy_key("Kp")), "") << controller;
    return settings.scaled(remedy_key("Kp"), 2);
  };
  EXPECT_EQ(doubled("type: pid, Kp: 60"), Sets{"controller.Kp=120"});
  EXPECT_EQ(doubled("type: rc_servo, gain: 3"), Sets{"controller.gain=6"});
  EXPECT_EQ(doubled("type: rc_servo, P: 400"), Sets{"controller.P=800"});
  EXPECT_EQ(doubled("type: rc_servo"), Sets{"controller.gain=10"}) << "the gain that is not stated";
  EXPECT_EQ(doubled("type: rc_servo, P: {default: 30, m1/active: 40}"), Sets{"controller.P=[60, 60, 80, 60]"});
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
    const RemedySettings settings(text);
    for (const RemedyKey& key : remedy_keys()) {
      if (!settings.missing(key).empty()) continue;
      std::vector<std::string> sets = settings.scaled(key, 1.1);
      const std::string of_record = resolved(read_record(text, folder / "resolved.yaml", sets, catalog()));
      sets.insert(sets.begin(), own.begin(), own.end());
      EXPECT_EQ(resolved(shipped(file, sets)), of_record) << file << " " << key.name;
    }
  }
}

/// The gait of an arm with one servo without u_max needs more speed than the servo has. A higher supply or a faster motor
/// suffices.
TEST(RemedyOfServos, HasASupplyAndAFasterMotor) {
  const std::string text =
      "gaitlab: 1\nrobot:\n  base: fixed\n  position: [0, 0, 1]\n  modules:\n    gaitlab_module: 1\n    name: lever\n    "
      "bodies:\n"
      "      base: {mass: 0.2, shape: [{box: [0.05, 0.05, 0.05]}]}\n"
      "      rod: {mass: 0.05, com: [0, 0, -0.08], inertia: [1e-4, 1e-4, 1e-5, 0, 0, 0]}\n"
      "    hinges: [{name: j, parent: base, child: rod, axis: [0, 1, 0], range: [-1.5, 1.5]}]\n"
      "    actuator: {type: servo, voltage: 5, stall_torque: 0.4, no_load_speed: 4, load_friction: 0, dry_friction: 0, "
      "viscous_friction: 0, rotor_inertia: 0, source: \"data sheet\"}\n"
      "    controller: {type: pid, Kp: 60, Kd: 0}\n"
      "physics: {engine: articulated}\nground: {type: none}\ncontact: {on: none}\n"
      "cpg: {type: sine, frequency: 0.95, amplitude: 0.8}\nduration: 4\n";
  const Scenario s = scenario(text);
  const Recording record = run(s);
  const report::Verdict verdict = report::verdict(s, record, report::summarise(s, record, 0), report::overlaps(s, record));
  ASSERT_EQ(verdict.word, Word::infeasible) << verdict.why();
  std::atomic<bool> stop = false;
  const report::Remedy made = report::remedy(
      {s, verdict, [&](const Sets& sets) { return scenario(text, sets); }, false, {"u_max", "no_load_speed"}, {}, {}}, stop);
  EXPECT_TRUE(made.lacking.empty());
  std::vector<std::string> helps;
  for (const report::RemedyAnswer& answer : made.answers) {
    if (!answer.confirmed) continue;
    helps.push_back(answer.sets.front());
    EXPECT_TRUE(answer.up) << answer.key->name;
    // The peak speed of the set point is 0.95 * 0.8 * 2 pi = 4.78 rad/s. The servo reaches 4 rad/s without load. The tolerance
    // is for the lag of the rod.
    EXPECT_NEAR(answer.factor, 4.78 / 4, 0.05) << answer.key->name;
  }
  ASSERT_EQ(helps.size(), 2U);
  EXPECT_TRUE(helps[0].starts_with("actuator.u_max=")) << helps[0];
  EXPECT_TRUE(helps[1].starts_with("actuator.no_load_speed=")) << helps[1];
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
std::string engine_of_search(const Sets& own, const Sets& other, Word word) {
  const Scenario s = scenario(kTwoInBullet, own);
  const Recording record = run(s);
  const report::Verdict verdict = report::verdict(s, record, report::summarise(s, record, 0), report::overlaps(s, record));
  EXPECT_EQ(verdict.word, word) << verdict.reason.text << verdict.why();
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
  EXPECT_EQ(engine_of_search({}, {}, Word::feasible), "articulated");
  const Sets weak{"actuator.i_continuous=0.001"};
  EXPECT_EQ(engine_of_search(weak, {}, Word::infeasible), "articulated");
}

TEST(RemedyEngine, IsThatOfTheScenarioWhereTheVerdictsDiffer) {
  const Sets weak{"actuator.i_continuous=0.001"}, strong{"actuator.i_continuous=1"};
  EXPECT_EQ(engine_of_search({}, weak, Word::feasible), "bullet");
  EXPECT_EQ(engine_of_search(weak, strong, Word::infeasible), "bullet");
}

}  // namespace
}  // namespace gaitlab::test
