// Steps that divide the periods of a scenario agree with a search in whole picoseconds. Tests the sentence about a step, too.
#include "core/simulation/step_advice.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace gaitlab {
namespace {

/// A period as a whole number of picoseconds.
std::int64_t picoseconds(double seconds) { return std::llround(seconds * 1e12); }

/// Largest step of the series, at most `limit`, that divides all of these periods, ps; 0 if no step from 10 ns up does.
std::int64_t largest_step(std::int64_t limit, const std::vector<std::int64_t>& periods) {
  std::int64_t best = 0;
  for (std::int64_t scale = 10'000; scale <= 1'000'000'000'000; scale *= 10) {  // 10 ns to a second
    for (const std::int64_t quarters : {4, 5, 8, 10, 20}) {
      const std::int64_t step = scale / 4 * quarters;
      bool divides = step <= limit;
      for (const std::int64_t period : periods) divides = divides && period % step == 0;
      if (divides) best = std::max(best, step);
    }
  }
  return best;
}

Scenario with_periods(double control, double trace, double duration) {
  Scenario s;
  s.control_period = control;
  s.trace.period = trace;
  s.duration = duration;
  return s;
}

TEST(UsableStep, IsTheLargestOfTheSeriesThatDividesThePeriods) {
  for (const double control : {0.015, 0.02, 0.001, 0.0125}) {
    for (const double trace : {0.005, 0.0025, 0.03, 0.007}) {
      for (const double duration : {20.0, 0.3, 0.49, 1.0}) {
        for (const double limit : {1.0, 5e-3, 4.99e-3, 1.3e-3, 1e-4, 2.6e-5}) {
          const std::int64_t expected =
              largest_step(picoseconds(limit), {picoseconds(control), picoseconds(trace), picoseconds(duration)});
          EXPECT_EQ(picoseconds(usable_step(with_periods(control, trace, duration), limit)), expected)
              << control << " " << trace << " " << duration << " " << limit;
        }
      }
    }
  }
}

TEST(UsableStep, IsNoneWherePeriodsHaveNoCommonStep) {
  EXPECT_EQ(usable_step(with_periods(0.015, 1.0 / 3, 20), 1), 0) << "a third of a second is no decimal number";
  EXPECT_EQ(usable_step(with_periods(0.015, 0.005, 20), 0), 0);
  EXPECT_EQ(usable_step(with_periods(0.015, 0.005, 20), 1e-8), 1e-8) << "the shortest step";
  EXPECT_EQ(usable_step(with_periods(0.015, 0.005, 20), 9e-9), 0);
}

struct Advised {
  Advised() {
    Robot robot;
    robot.joints = {{.name = "m0/active"}, {.name = "m0/passive"}};
    scenario = with_periods(0.015, 0.005, 20);
    scenario.robot = std::make_shared<const Robot>(robot);
    scenario.physics.step = 5e-3;
    contacts.push_back({.name = "m3/passive/p0"});
  }
  [[nodiscard]] std::string source(Stability::Source of, std::size_t index) const {
    return source_of({.rate = 1, .source = of, .index = index}, *scenario.robot, contacts);
  }
  Scenario scenario;
  std::vector<ContactElement> contacts;
};

TEST(SourceOf, NamesTheJointOrTheContact) {
  const Advised of;
  EXPECT_EQ(of.source(Stability::Source::motor, 1), "the motor of joint m0/passive");
  EXPECT_EQ(of.source(Stability::Source::stop, 0), "the hinge stop of joint m0/active");
  EXPECT_EQ(of.source(Stability::Source::contact, 0), "the contact m3/passive/p0");
  EXPECT_EQ(of.source(Stability::Source::hinge, 1), "spring, damper and friction of joint m0/passive");
}

TEST(StepAdvice, NamesALimitAndAStepBelowIt) {
  Advised of;
  const Stability stability{.rate = 800, .source = Stability::Source::contact, .index = 0};
  EXPECT_EQ(step_advice(of.scenario, of.contacts, stability, "standing"),
            "step 0.005 s is too long: the largest allowed is 0.00125 s, set by the contact m3/passive/p0 (standing; "
            "h lambda = 4, allowed up to 1); use step: 0.00125");
  of.scenario.trace.period = 1.0 / 3;
  EXPECT_EQ(step_advice(of.scenario, of.contacts, stability, "at t = 3.1 s"),
            "step 0.005 s is too long: the largest allowed is 0.00125 s, set by the contact m3/passive/p0 (at t = 3.1 s; "
            "h lambda = 4, allowed up to 1)");
}

}  // namespace
}  // namespace gaitlab
