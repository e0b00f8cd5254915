// Own values of a scenario for the parameters of a study: numbers, entries of lists, joints, defaults of the file, words.
#include "studies/plan/own_values.h"

#include <gtest/gtest.h>

#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

/// Own value of a parameter, or the reason why there is none. `lines` are further lines of the study.
std::string own_of(const std::string& parameter, const std::string& lines = "") {
  const SmallStudy study("parameters: {" + parameter + "}\nguards: none\nmethod: {type: random}\nbudget: {runs: 1}\n" + lines);
  const studies::OwnValue own = studies::own_values(study.plan->study(), study.plan->scenarios().front()).front();
  EXPECT_NE(own.text.empty(), own.missing.empty());
  return own.text + own.missing;
}

TEST(OwnValues, AreThoseOfTheResolvedScenario) {
  EXPECT_EQ(own_of("cpg.frequency: {low: 0.5, high: 2}"), "1");
  EXPECT_EQ(own_of("cpg.frequency: {low: 0.5, high: 2}", "set: [cpg.frequency=1.25]\n"), "1.25");
  EXPECT_EQ(own_of("cpg.amplitude.m1/active: {low: 0, high: 1}"), "0.6") << "one number for all joints";
  EXPECT_EQ(own_of("cpg.amplitude.m1/active: {low: 0, high: 1}", "set: ['cpg.amplitude={default: 0.3, m1/active: 0.4}']\n"),
            "0.4");
  EXPECT_EQ(own_of("cpg.type: {values: [hopf, phase_oscillator]}"), "phase_oscillator");
}

TEST(OwnValues, OfAnEntryOfAListAreThatEntry) {
  EXPECT_EQ(own_of("robot.position.1: {low: -1, high: 1}", "set: ['robot.position=[0, 0.25, 0.1]']\n"), "0.25");
}

TEST(OwnValues, HaveAReasonWhereThereIsNone) {
  EXPECT_EQ(own_of("cpg.frequency: {low: 1.5, high: 2}"), "is 1 in the scenario, outside the parameter's range");
  EXPECT_EQ(own_of("cpg.type: {values: [hopf, sine]}"),
            "is phase_oscillator in the scenario, not one of the parameter's values");
  EXPECT_EQ(own_of("legs: {low: 0, high: 1, sets: {cpg.offset: legs}}"),
            "is a parameter of the study, without a value in the scenario");
  EXPECT_EQ(own_of("cpg.amplitude.default: {low: 0, high: 1}"), "has no single value in the scenario");
}

/// The default of joints is lost in the resolved scenario, which has a number for each joint.
TEST(OwnValues, OfADefaultOfJointsAreThatOfTheFile) {
  const std::string file = kScenarios + "library/rofi-snake.yaml";
  EXPECT_EQ(own_of("cpg.amplitude.default: {low: 0.1, high: 1.2}", "scenario: " + file + "\n"), "0.5");
  EXPECT_EQ(own_of("cpg.amplitude.default: {low: 0.1, high: 1.2}", "scenario: " + file + "\nset: [cpg.amplitude=0.3]\n"),
            "has no single value in the scenario");
}

}  // namespace
}  // namespace gaitlab::test
