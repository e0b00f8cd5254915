// Tests of the word of a run without the friction of its servos that is only chosen.
#include "report/verdict/frictionless.h"

#include <nlohmann/json.hpp>

#include "core/scenario/chosen_friction.h"
#include "report/analysis/collisions.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;
using Sets = std::vector<std::string>;

const std::string kSentence = ", with the friction chosen; feasible without";
const Sets kNone{"actuator.dry_friction=0", "actuator.viscous_friction=0", "actuator.load_friction=0",
                 "actuator.rotor_inertia=0"};

/// Three periods of 2 s after the ramp. Their friction alone needs too much voltage.
const std::string kSnake = kScenarios + "library/y1-snake.yaml --set duration=8 ";

/// Output of the program without its line breaks.
std::string unwrapped(std::string text) {
  const std::string indent = "\n            ";
  for (std::size_t at = text.find(indent); at != std::string::npos; at = text.find(indent, at))
    text.replace(at, indent.size(), " ");
  return text;
}

Scenario two_servos(const std::string& keys) {
  return scenario(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncpg: {type: phase_oscillator, frequency: 1}\nduration: "
      "1\n"
      "actuator: {type: servo, voltage: 6, stall_torque: 2, no_load_speed: 5" +
      keys + "}\n");
}

/// The defaults of `servo` are chosen, key by key and joint by joint. Stated values stay.
TEST(ChosenFriction, IsWhatNobodyStates) {
  EXPECT_EQ(without_chosen_friction(two_servos("")), kNone);
  EXPECT_EQ(without_chosen_friction(two_servos(", dry_friction: 0.06, rotor_inertia: 0")),
            (Sets{"actuator.viscous_friction=0", "actuator.load_friction=0"}));
  EXPECT_EQ(without_chosen_friction(two_servos(", viscous_friction: {m0/*: 0.25}")),
            (Sets{kNone[0], "actuator.viscous_friction=[0.25, 0.25, 0, 0]", kNone[2], kNone[3]}));
  EXPECT_EQ(
      without_chosen_friction(two_servos(", dry_friction: 0, viscous_friction: 0.1, load_friction: 0.2, rotor_inertia: 0.001")),
      Sets{});
  EXPECT_EQ(without_chosen_friction(shipped("caterpillar.yaml")), Sets{}) << "dc_motor has none by default";
  EXPECT_EQ(without_chosen_friction(shipped("pendulum.yaml")), Sets{}) << "no actuator";
}

/// By the rule of servo, the inertia is 0.03 s x 2 N m / 5 rad/s and the viscous friction 10 % of 2 N m / 5 rad/s.
TEST(ChosenFriction, IsMultiplied) {
  EXPECT_EQ(times_chosen(two_servos(""), "rotor_inertia", 0.5), "actuator.rotor_inertia=0.006");
  EXPECT_EQ(times_chosen(two_servos(", viscous_friction: {m0/*: 0.25}"), "viscous_friction", 2),
            "actuator.viscous_friction=[0.25, 0.25, 0.08, 0.08]");
  EXPECT_EQ(times_chosen(two_servos(", rotor_inertia: 0.01"), "rotor_inertia", 2), "");
}

/// Terminal, verdict.json and page have the sentence, and `report` repeats it from verdict.json.
TEST(Frictionless, AWordOfChosenFrictionAloneIsTold) {
  const Folder folder;
  const Result made = gaitlab("run " + kSnake + "--out a", folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string file = read(folder / "a/verdict.json");
  const nlohmann::json verdict = nlohmann::json::parse(file);
  EXPECT_EQ(verdict.at("verdict"), "infeasible");
  EXPECT_EQ(verdict.at("without_chosen_friction"), "feasible");
  EXPECT_TRUE(contains(unwrapped(made.out), kSentence)) << made.out;
  EXPECT_TRUE(contains(made.err, "infeasible; simulated again without the chosen friction of its servos")) << made.err;
  EXPECT_TRUE(contains(read(folder / "a/report.html"), kSentence));
  // A separate run without the four numbers has that word.
  const Scenario bare = shipped("library/y1-snake.yaml", {"duration=8", kNone[0], kNone[1], kNone[2], kNone[3]});
  const Recording record = run(bare);
  EXPECT_EQ(report::verdict(bare, record, summarise(bare, record, 0), overlaps(bare, record)).word, Word::feasible);

  const Result again = gaitlab("report a --out b", folder.path());
  EXPECT_TRUE(contains(unwrapped(again.out), kSentence)) << again.out;
  EXPECT_TRUE(read(folder / "b/verdict.json") == file);
  // A changed file is not used.
  for (const auto& [key, value] : {std::pair<std::string, nlohmann::json>{"decided_by", "heat"}, {"window", 3}}) {
    nlohmann::json other = verdict;
    other[key] = value;
    folder.write("a/verdict.json", other.dump());
    const Result without = gaitlab("report a", folder.path());
    EXPECT_TRUE(contains(without.err, "belongs to another recording; its results of second runs are not shown"))
        << key << without.err;
    EXPECT_FALSE(contains(unwrapped(without.out), kSentence)) << key;
  }
}

/// Friction that is stated is not chosen, even if its numbers are those of the defaults: no second run and no sentence.
TEST(Frictionless, OfStatedFrictionIsNotAsked) {
  const Folder folder;
  const Scenario own = shipped("library/y1-snake.yaml");
  std::string sets;
  for (const char* const key : kChosenFriction) sets += "--set " + times_chosen(own, key, 1) + " ";
  const Result made = gaitlab("run " + kSnake + sets + "--no-report --out a", folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(contains(made.out, "verdict   infeasible: ")) << made.out;
  EXPECT_FALSE(contains(unwrapped(made.out), kSentence)) << made.out;
  EXPECT_EQ(nlohmann::json::parse(read(folder / "a/verdict.json")).count("without_chosen_friction"), 0U);
  EXPECT_FALSE(contains(made.err, "simulated again")) << made.err;
}

/// A gait that lacks more than friction takes: the word is stored, and the sentence does not change.
TEST(Frictionless, OfAGaitThatIsInfeasibleWithoutAddsNoSentence) {
  const Folder folder;
  const Result made = gaitlab("run " + kSnake + "--set actuator.i_continuous=0.01 --no-report --out a", folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  const nlohmann::json verdict = nlohmann::json::parse(read(folder / "a/verdict.json"));
  EXPECT_EQ(verdict.at("without_chosen_friction"), "infeasible");
  EXPECT_FALSE(contains(unwrapped(made.out), "feasible without")) << made.out;
}

/// Studies judge many runs, and do not simulate any of them twice.
TEST(Frictionless, IsNotAskedInStudies) {
  const Folder folder;
  const Result made = gaitlab("sweep " + kSnake + "--grid cpg.frequency=0.5 --out s --quiet", folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string table = read(folder / "s/table.csv");
  EXPECT_TRUE(contains(table, "infeasible")) << table;
  EXPECT_FALSE(contains(table, kSentence)) << table;
}

}  // namespace
}  // namespace gaitlab::test
