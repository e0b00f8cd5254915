// The scenarios of a study as one text, and the problems of several scenarios as one list.
#include "studies/study/scenarios.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/scenario/resolved.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using studies::ScenarioText;
using studies::Study;
using studies::StudyScenario;
using Texts = std::vector<std::string>;

StudyScenario scenario_named(const std::string& name, const std::string& text) {
  StudyScenario made{name};
  made.resolved = text;
  return made;
}

/// `NAME|TEXT` of each.
Texts parts(const std::string& text) {
  Texts all;
  for (const ScenarioText& one : studies::scenario_texts(text)) all.push_back(one.name + "|" + one.text);
  return all;
}

TEST(ScenariosText, ComesApartAsItWasPutTogether) {
  std::vector<StudyScenario> scenarios;
  scenarios.push_back(scenario_named("flat", "gaitlab: 1\nname: a\n"));
  scenarios.push_back(scenario_named("a b # c", "gaitlab: 1\nname: \"--- # scenario x\"\n"));
  scenarios.push_back(scenario_named("empty", ""));
  EXPECT_EQ(parts(studies::scenarios_text(scenarios)),
            (Texts{"flat|gaitlab: 1\nname: a\n", "a b # c|gaitlab: 1\nname: \"--- # scenario x\"\n", "empty|"}));
}

TEST(ScenariosText, OfASingleOneIsItsText) {
  std::vector<StudyScenario> scenarios;
  scenarios.push_back(scenario_named("", "gaitlab: 1\n"));
  EXPECT_EQ(studies::scenarios_text(scenarios), "gaitlab: 1\n");
  EXPECT_EQ(parts("gaitlab: 1\n"), Texts{});
  EXPECT_EQ(parts(""), Texts{});
}

/// The texts of a forged journal may end anywhere, and none is read beyond its end.
TEST(ScenariosText, OfAForgedJournalEnds) {
  const std::string whole = "--- # scenario a\nx: 1\n--- # scenario b\ny: 2\n";
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    std::string together;
    for (const ScenarioText& one : studies::scenario_texts(whole.substr(0, size))) together += one.name + one.text;
    EXPECT_LE(together.size(), size);
  }
  EXPECT_EQ(parts("--- # scenario "), Texts{"|"});
  EXPECT_EQ(parts("--- # scenario a"), Texts{"a|"});
  EXPECT_EQ(parts(" --- # scenario a\n"), Texts{});
}

Texts told(const Problems& problems) {
  Texts all;
  for (const Problem& p : problems.list()) all.push_back(to_string(p.place) + " " + p.text);
  return all;
}

TEST(ProblemsOfEach, AreToldOnceWhereAllHaveThem) {
  std::vector<StudyScenario> scenarios;
  for (const char* name : {"flat", "rubble", "slope"}) scenarios.push_back(scenario_named(name, ""));
  std::vector<Problems> found(3);
  for (Problems& one : found) one.add({"s.yaml", 3, 1}, "everywhere");
  found[1].add({"s.yaml", 4, 1}, "one");
  found[1].add({"s.yaml", 5, 1}, "elsewhere");
  found[2].add({"s.yaml", 6, 1}, "elsewhere");
  Problems problems;
  studies::add_of_each(scenarios, found, problems);
  EXPECT_EQ(told(problems), (Texts{"s.yaml:3:1 everywhere", "s.yaml:4:1 one (in scenario rubble)",
                                   "s.yaml:5:1 elsewhere (in scenario rubble)", "s.yaml:6:1 elsewhere (in scenario slope)"}))
      << "another place is another problem";
}

TEST(ProblemsOfEach, OfASingleScenarioHaveNoName) {
  std::vector<StudyScenario> scenarios;
  scenarios.push_back(scenario_named("", ""));
  std::vector<Problems> found(1);
  found[0].add({"s.yaml", 3, 1}, "wrong").notes.push_back({{"t.yaml", 1, 1}, "a note"});
  Problems problems;
  studies::add_of_each(scenarios, found, problems);
  EXPECT_EQ(told(problems), Texts{"s.yaml:3:1 wrong"});
  EXPECT_EQ(problems.list()[0].notes.size(), 1U);
}

/// A message on `--set KEY=VALUE` comes from the line of the study that makes the setting.
TEST(ProblemsOfSettings, AreAtTheLineThatMakesThem) {
  Study study;
  study.sets = {"duration=1", "seed=2"};
  study.set_places = {{"s.yaml", 2, 7}, {"s.yaml", 2, 19}};
  studies::Parameter parameter;
  parameter.key = "cpg.frequency";
  parameter.place = {"s.yaml", 4, 3};
  studies::Parameter own;
  own.key = "legs";
  own.place = {"s.yaml", 5, 3};
  own.sets.push_back({"cpg.offset", {}, {"s.yaml", 5, 30}});
  study.parameters = {parameter, own};
  studies::Variation variation;
  variation.key = "ground.friction";
  variation.place = {"s.yaml", 7, 5};
  study.replicates.vary = {variation};
  const auto place = [&](const std::string& file) {
    Problems problems;
    studies::add_as_written(InputError(SourceLocation{file, 0, 0}, "wrong"), study, problems);
    return told(problems);
  };
  EXPECT_EQ(place("--set seed=2"), Texts{"s.yaml:2:19 wrong"});
  EXPECT_EQ(place("--set cpg.frequency=30"), Texts{"s.yaml:4:3 wrong"});
  EXPECT_EQ(place("--set cpg.offset=9"), Texts{"s.yaml:5:30 wrong"});
  EXPECT_EQ(place("--set ground.friction=-1"), Texts{"s.yaml:7:5 wrong"});
  EXPECT_EQ(place("--set cpg.frequenc=30"), Texts{"--set cpg.frequenc=30 wrong"});
  EXPECT_EQ(place("two.yaml"), Texts{"two.yaml wrong"});
  Problems problems;
  for (const char* value : {"30", "31"})
    studies::add_as_written(InputError(SourceLocation{std::string("--set cpg.frequency=") + value}, "wrong"), study, problems);
  EXPECT_EQ(problems.size(), 1U) << "the same sentence at the same place";
}

TEST(ReadScenarios, TakesTheSettingsOfTheStudyAndNamesJoints) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  const std::string text = "gaitlab: 1\nrobot: {modules: mtran}\nphysics: {engine: articulated}\nduration: ";
  folder.write("one.yaml", text + "1\n");
  folder.write("two.yaml", text + "2\n");
  Study study;
  study.scenarios = {{"a", folder / "one.yaml"}, {"b", folder / "two.yaml"}};
  study.sets = {"seed=7"};
  const std::vector<StudyScenario> read = studies::read_scenarios(study, {}, catalog());
  ASSERT_EQ(read.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(read[k].name, study.scenarios[k].name);
    EXPECT_EQ(read[k].nominal.duration, k == 0 ? 1 : 2);
    EXPECT_EQ(read[k].nominal.seed, 7);
    EXPECT_EQ(read[k].resolved, resolved(read[k].nominal));
    EXPECT_EQ(read[k].joints, (Texts{"m0/active", "m0/passive"}));
  }
  folder.write("two.yaml", text + "-1\n");
  study.sets.emplace_back("sed=7");
  const std::string said = message_of([&] { (void)studies::read_scenarios(study, {}, catalog()); });
  EXPECT_TRUE(contains(said, "unknown key 'sed'")) << said;
  EXPECT_TRUE(contains(said, "two.yaml:4:11: error: duration is -1 s")) << said;
  EXPECT_EQ(said.find("unknown key 'sed'"), said.rfind("unknown key 'sed'")) << "both scenarios have it: once";
}

}  // namespace
}  // namespace gaitlab::test
