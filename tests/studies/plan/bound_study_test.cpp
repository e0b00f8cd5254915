// A study bound to its scenarios: durations, columns to show, engines for verification.
#include "studies/plan/bound_study.h"

#include <gtest/gtest.h>

#include "tests/messages.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::BoundStudy;

const std::string kGrid = "parameters: {cpg.frequency: {low: 0.5, high: 1.5, count: 3}}\nguards: none\n";

/// Names of the quantities shown.
std::vector<std::string> shown(const std::string& lines) {
  const SmallStudy study(kGrid + lines);
  std::vector<std::string> names;
  for (const std::size_t column : study.plan->bound().shown()) names.push_back(study.plan->columns()[column].name);
  return names;
}

using Names = std::vector<std::string>;

TEST(BoundStudies, ShowTheQuantitiesOfTheirPatterns) {
  EXPECT_EQ(shown(""), Names{"speed"});
  EXPECT_EQ(shown("quantities: [torque.rms, speed, torque.rms]\n"), (Names{"torque.rms", "speed"}))
      << "each once, as asked for";
  EXPECT_EQ(shown("quantities: [\"torque.peak[m?/active]\"]\n"), (Names{"torque.peak[m0/active]", "torque.peak[m1/active]"}));
}

TEST(BoundStudies, SayWhichPatternNamesNothing) {
  const std::string said = message_of([] { shown("quantities: [spee]\n"); });
  EXPECT_TRUE(contains(said, "error: no quantity is named 'spee'; did you mean 'speed'?")) << said;
}

TEST(BoundStudies, HaveTheFirstQuantityShownAsTheirObjective) {
  const SmallStudy first(kGrid + "quantities: [torque.rms, speed]\n");
  EXPECT_EQ(first.plan->bound().study().objectives.front().expression.text, "torque.rms");
  const SmallStudy own(kGrid + "quantities: [torque.rms, speed]\nobjective: {minimize: 2*speed}\n");
  EXPECT_EQ(own.plan->bound().study().objectives.front().expression.text, "2*speed");
}

TEST(BoundStudies, KnowTheirLongestScenario) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  const std::string text = "gaitlab: 1\nrobot: {modules: mtran}\nphysics: {engine: articulated}\ncpg: {type: sine}\nduration: ";
  studies::Study study;
  for (const char* duration : {"0.25", "0.75", "0.5"}) {
    const std::string name = std::string("s") + duration;
    study.scenarios.push_back({name, folder.write(name + ".yaml", text + duration + "\n")});
  }
  const BoundStudy bound(study, app::quantity_offer(), catalog());
  EXPECT_EQ(bound.longest(), 0.75);
  EXPECT_EQ(bound.with({"duration=2"}, 2).duration, 2);
  EXPECT_EQ(bound.with({}, 2).duration, 0.5);
  EXPECT_EQ(studies::scenario_texts(bound.scenario_text()).size(), 3U);
  studies::Study late = study;
  late.stops.push_back({{"fell", Node{Node::Kind::scalar, {"s.yaml", 1, 1}, "fell"}}, 0.75});
  EXPECT_EQ(message_of([&] { BoundStudy(late, app::quantity_offer(), catalog()).problems().raise(); }),
            "s.yaml:1:1: error: the rule begins at 0.75 s, but the longest run ends at 0.75 s; expected a smaller number after "
            "`after`");
}

TEST(BoundStudies, VerifyInAnotherEngineWithItsOwnStep) {
  const SmallStudy none(kGrid);
  EXPECT_FALSE(none.plan->bound().has_other_engine());
  const std::string search = "parameters: {cpg.frequency: {low: 0.5, high: 1.5}}\nbudget: {runs: 64}\n";
  const SmallStudy study(search + "verify: {engine: bullet}\n", studies::Purpose::optimize);
  EXPECT_TRUE(study.plan->bound().has_other_engine());
  const Scenario other = study.plan->with(study.plan->scenarios().front().other_engine, 0);
  EXPECT_EQ(other.physics.engine->name, "bullet");
  EXPECT_EQ(study.plan->scenario().physics.engine->name, "articulated");
  // A stated accuracy is left out, because engine bullet refuses it. Gravity stays.
  const SmallStudy accurate(
      search + "set: [physics.accuracy=0.001, 'physics.gravity=[0, 0, -1.6]']\nverify: {engine: bullet}\n",
      studies::Purpose::optimize);
  const Scenario light = accurate.plan->with(accurate.plan->scenarios().front().other_engine, 0);
  EXPECT_EQ(light.physics.engine->name, "bullet");
  EXPECT_TRUE(light.physics.chosen_step);
  EXPECT_EQ(light.physics.gravity.z(), -1.6);
  // If a motor is too stiff for the engine's longest step, a shorter step is used.
  const SmallStudy stiff(search + "set: [actuator.R=0.2]\nverify: {engine: bullet}\n", studies::Purpose::optimize);
  EXPECT_LT(stiff.plan->with(stiff.plan->scenarios().front().other_engine, 0).physics.step, other.physics.step);
  const auto said = [&](const std::string& engine) {
    return message_of(
        [&] { const SmallStudy wrong(search + "verify: {engine: " + engine + "}\n", studies::Purpose::optimize); });
  };
  EXPECT_TRUE(contains(said("articulated"), "verify.engine is articulated, the engine of the study itself"))
      << said("articulated");
  EXPECT_TRUE(contains(said("bulet"), "verify.engine 'bulet' is not known; did you mean 'bullet'?")) << said("bulet");
}

}  // namespace
}  // namespace gaitlab::test
