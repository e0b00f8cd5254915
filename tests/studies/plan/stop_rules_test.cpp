// Tests of rules that end a run early: their start, their values, and the names that they may use.
#include "studies/plan/stop_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace gaitlab::studies {
namespace {

/// Rules over fictitious quantities. `fell` and `heat`, also of joints, are known during a run; `speed` is not.
class RuledRun {
 public:
  explicit RuledRun(const std::vector<std::pair<std::string, double>>& rules)
      : rules_(study(rules), offer(), kJoints, std::vector<MarginGuard>{{"voltage", "margin.voltage", 0, 0, true}}, problems_) {
  }

  void set(const std::string& quantity, double value) { values_[quantity] = value; }
  void lose(Cause check) { lost_ = std::move(check); }
  [[nodiscard]] std::string at(double time, bool whole = false) const {
    Recording so_far;
    so_far.simulated = time;
    return rules_.reason({}, so_far, whole);
  }
  [[nodiscard]] const StopRules& rules() const { return rules_; }
  [[nodiscard]] std::vector<std::string> problems() const {
    std::vector<std::string> all;
    for (const Problem& problem : problems_.list()) all.push_back(problem.text);
    return all;
  }
  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  inline static const std::vector<std::string> kJoints{"m0/active", "m0/passive"};
  static Study study(const std::vector<std::pair<std::string, double>>& rules) {
    Study made;
    for (const auto& [text, after] : rules) {
      Node node{Node::Kind::scalar, {"s.yaml", 1, 1}};
      node.text = text;
      made.stops.push_back({{text, node}, after});
    }
    return made;
  }
  QuantityOffer offer() {
    QuantityOffer made;
    made.common = {{"speed", "m/s", ""}, {"fell", "", ""}, {"heat", "K", ""}};
    made.of_joints = {{"heat", "K", ""}, {"wear", "", ""}};
    made.so_far = {"fell", "heat"};
    made.value_so_far = [this](const std::string& name, const std::string& joint, const Scenario&, const Recording&) {
      ++evaluations_;
      return values_.at(joint.empty() ? name : name + "[" + joint + "]");
    };
    made.lost_so_far = [this](std::span<const MarginGuard> guards, const Scenario&, const Recording&) {
      EXPECT_EQ(guards.size(), 1U);
      EXPECT_EQ(guards.front().name, "margin.voltage");
      return lost_;
    };
    return made;
  }

  Problems problems_;
  Cause lost_;
  std::map<std::string, double> values_;
  int evaluations_ = 0;
  StopRules rules_;
};

TEST(StopRules, HoldFromTheirTimeOn) {
  RuledRun run({{"fell", 0}, {"heat > 70", 4}});
  run.set("fell", 0);
  run.set("heat", 80);
  EXPECT_EQ(run.at(1), "");
  EXPECT_EQ(run.at(3.5), "");
  EXPECT_EQ(run.at(4), "stopped by heat > 70 after 4 at t = 4 s");
  EXPECT_EQ(run.at(9), "stopped by heat > 70 after 4 at t = 9 s");
  run.set("fell", 1);
  EXPECT_EQ(run.at(1), "stopped by fell at t = 1 s");
  EXPECT_EQ(run.at(9), "stopped by fell at t = 9 s") << "the first of the study";
}

/// A run tests rules at whole seconds, computed as a number of steps times the step. In doubles, 10000 * 0.0003 s is less than
/// 3 s.
TEST(StopRules, HoldAtASecondThatIsRounded) {
  RuledRun run({{"fell", 3}});
  run.set("fell", 1);
  const double step = 0.0003;
  ASSERT_LT(10000 * step, 3);
  EXPECT_EQ(run.at(10000 * step), "stopped by fell after 3 at t = 3 s");
  EXPECT_EQ(run.at(9999 * step), "");
}

TEST(StopRules, DoNotHoldForAnUnknownValue) {
  RuledRun run({{"heat > 70", 0}, {"heat <= 70", 0}, {"heat != heat", 0}, {"heat", 0}});
  run.set("heat", std::nan(""));
  EXPECT_EQ(run.at(5), "");
  run.set("heat", 0);
  EXPECT_EQ(run.at(5), "stopped by heat <= 70 at t = 5 s");
}

TEST(StopRules, ReadAQuantityOfTheJointThatTheyName) {
  RuledRun run({{"heat[m0/passive] > heat[m0/active] + heat", 0}});
  run.set("heat", 1);
  run.set("heat[m0/active]", 2);
  run.set("heat[m0/passive]", 3);
  EXPECT_EQ(run.at(1), "");
  run.set("heat[m0/passive]", 3.5);
  EXPECT_EQ(run.at(1), "stopped by heat[m0/passive] > heat[m0/active] + heat at t = 1 s");
}

/// Quantities of rules that do not apply yet are not computed, because they may be expensive or not known yet.
TEST(StopRules, ComputeEachQuantityOnceAndNoneTooEarly) {
  RuledRun run({{"heat > 70", 4}, {"heat > 60 and fell", 4}});
  run.set("heat", 0);
  run.set("fell", 0);
  (void)run.at(3);
  EXPECT_EQ(run.evaluations(), 0);
  (void)run.at(4);
  EXPECT_EQ(run.evaluations(), 2);
}

TEST(StopRules, SayWhichNamesTheyDoNotKnow) {
  const auto problem = [](const std::string& rule) {
    const RuledRun run({{rule, 0}});
    return run.problems();
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(problem("fell and heat[m0/active] > 3"), Texts{});
  EXPECT_EQ(problem("speed < 0.1"), Texts{"speed is known only after a run has ended; a stop rule can use fell, heat"});
  EXPECT_EQ(problem("wear[m0/active] > 1"), Texts{"wear is known only after a run has ended; a stop rule can use fell, heat"});
  EXPECT_EQ(problem("fel"), Texts{"unknown quantity 'fel'; did you mean 'fell'?"});
  EXPECT_EQ(problem("fell[m0/active]"), Texts{"unknown quantity 'fell'; did you mean 'fell'?"});
  EXPECT_EQ(problem("heat[m0/activ]"), Texts{"no joint is called 'm0/activ'; did you mean 'm0/active'?"});
}

TEST(StopRules, StopAHopelessRunUnlessItIsToBeWhole) {
  RuledRun run({{"hopeless", 2}, {"fell", 0}});
  run.set("fell", 0);
  EXPECT_EQ(run.at(4), "");
  run.lose({"voltage", "m0/active"});
  EXPECT_EQ(run.at(1), "");
  EXPECT_EQ(run.at(4), "stopped by hopeless after 2 at t = 4 s: voltage of m0/active");
  EXPECT_EQ(run.at(4, true), "");
  run.set("fell", 1);
  EXPECT_EQ(run.at(4, true), "stopped by fell at t = 4 s") << "other rules of the study hold";
  EXPECT_TRUE(run.problems().empty());
  EXPECT_EQ(run.rules().texts(), (std::vector<std::string>{"hopeless after 2", "fell"}));
}

TEST(StopRules, HaveTheirTexts) {
  EXPECT_TRUE(RuledRun({}).rules().empty());
  EXPECT_EQ(RuledRun({}).at(100), "");
  const RuledRun run({{"fell", 0}, {"heat > 70", 0.5}});
  EXPECT_FALSE(run.rules().empty());
  EXPECT_EQ(run.rules().texts(), (std::vector<std::string>{"fell", "heat > 70 after 0.5"}));
}

}  // namespace
}  // namespace gaitlab::studies
