// Expressions over the quantities of a run: names, unknown values, and faults at their places.
#include "studies/study/formula.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace gaitlab::studies {
namespace {

/// Columns: speed, torque.peak, torque.peak[m0/active].
Naming column_named(const std::string& name, const std::string& joint) {
  if (name == "speed" && joint.empty()) return {0};
  if (name == "torque.peak" && joint.empty()) return {1};
  if (name == "torque.peak" && joint == "m0/active") return {2};
  return {{}, "there is no " + name + (joint.empty() ? "" : " of " + joint)};
}

/// A text at line 3 of a study.
FormulaText study_text(const std::string& text) {
  const Node study = parse_yaml("gaitlab_study: 1\nrules:\n  rule: " + text + "\n", "s.yaml");
  const Node node = *study.find("rules")->find("rule");
  return {node.text, node};
}

Formula formula(const std::string& text) {
  Problems problems;
  Formula made(study_text(text), column_named, problems);
  problems.raise();
  return made;
}

/// `LINE:COLUMN: TEXT` of each fault.
std::vector<std::string> faults(const std::string& text) {
  Problems problems;
  const Formula made(study_text(text), column_named, problems);
  std::vector<std::string> all;
  for (const Problem& p : problems.list())
    all.push_back(std::to_string(p.place.line) + ":" + std::to_string(p.place.column) + ": " + p.text);
  return all;
}

TEST(Formula, IsComputedFromTheColumnsThatItNames) {
  const std::array<double, 3> quantities{0.5, 8, 3};
  const auto value = [&](const std::string& text) { return formula(text).value(quantities); };
  EXPECT_EQ(value("speed"), 0.5);
  EXPECT_EQ(value("torque.peak - torque.peak[m0/active]"), 5);
  EXPECT_EQ(value("max(speed, 2) * clamp(torque.peak, 0, 4)"), 8);
  EXPECT_EQ(value("if(torque.peak > 7, 10, 20)"), 10);
  EXPECT_EQ(value("-torque.peak^2"), -64);
  EXPECT_EQ(value("2*pi"), 2 * std::numbers::pi);
  EXPECT_EQ(value("not (speed > 0.4 and torque.peak >= 8)"), 0);
}

/// A comparison with an unknown value is neither true nor false, whatever operators enclose it.
TEST(Formula, IsUnknownWhereAQuantityIsUnknown) {
  const double unknown = std::nan("");
  const std::array<double, 3> quantities{unknown, 8, 3};
  for (const char* text :
       {"speed", "speed > 0", "speed < 0", "speed == speed", "speed != 3", "not speed", "speed > 0 or torque.peak > 1",
        "torque.peak > 1 or speed > 0", "torque.peak < 1 and speed > 0", "min(1, speed)", "max(speed, 1)", "clamp(1, 0, speed)",
        "if(speed, 1, 2)", "speed^0", "0*speed", "sign(speed)"})
    EXPECT_TRUE(std::isnan(formula(text).value(quantities))) << text;
  EXPECT_EQ(formula("torque.peak + 1").value(quantities), 9) << "the others are known";
  EXPECT_EQ(formula("torque.peak > 1").value(std::array{0.0, std::numeric_limits<double>::infinity(), 0.0}), 1);
}

TEST(Formula, KnowsItsComparison) {
  const std::array<double, 3> quantities{0.5, 8, 3};
  const Formula made = formula("torque.peak - 1 <= 2*torque.peak[m0/active]");
  EXPECT_TRUE(made.compares("<="));
  EXPECT_FALSE(made.compares("<"));
  EXPECT_FALSE(formula("speed").compares("<="));
  EXPECT_EQ(made.operand(0, quantities), 7);
  EXPECT_EQ(made.operand(1, quantities), 6);
}

TEST(Formula, KnowsTheQuantitiesInIt) {
  const Formula made = formula("min(1, abs(-torque.peak[m0/active])) > 3 - pi");
  EXPECT_TRUE(made.names("torque.peak"));
  EXPECT_FALSE(made.names("torque"));
  EXPECT_FALSE(made.names("speed"));
  EXPECT_FALSE(made.names("pi")) << "a number";
  EXPECT_FALSE(made.names("min")) << "a function";
}

TEST(Formula, TellsEveryFaultAtItsPlace) {
  EXPECT_EQ(faults("speed > 1"), std::vector<std::string>{});
  EXPECT_EQ(faults("sped + torque.peak[m9/active]"),
            (std::vector<std::string>{"3:9: there is no sped", "3:16: there is no torque.peak of m9/active"}));
  EXPECT_EQ(faults("'1 + mx(speed)'"), std::vector<std::string>{"3:14: unknown function 'mx'; did you mean 'max'?"});
  EXPECT_EQ(faults("min(speed) + abs(1, 2)"),
            (std::vector<std::string>{"3:9: min takes 2 arguments, found 1", "3:22: abs takes 1 argument, found 2"}));
  EXPECT_EQ(faults("speed +").size(), 1U);
  EXPECT_EQ(faults("pi[m0/active]"), std::vector<std::string>{"3:9: there is no pi of m0/active"});
}

TEST(NamedJoints, AreThoseOfTheTextInItsOrder) {
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(named_joints("max(torque.peak[m0/active], 2*speed) - heat[ m1/passive ]"),
            (Pairs{{"torque.peak", "m0/active"}, {"heat", "m1/passive"}}));
  EXPECT_EQ(named_joints("speed + 1"), Pairs{});
  EXPECT_EQ(named_joints("heat[m0/active] +"), Pairs{}) << "no expression";
}

}  // namespace
}  // namespace gaitlab::studies
