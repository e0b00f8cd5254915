// Lines of a remedy: settings with one value and with several, values that the scenario refuses, reserves.
#include "report/remedy/remedy_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gaitlab::test {
namespace {

using report::Remedy;
using report::RemedyAnswer;
using report::RemedyKey;
using Lines = std::vector<std::string>;

const RemedyKey* key_named(const std::string& name) {
  return &*std::ranges::find_if(report::remedy_keys(), [&](const RemedyKey& key) { return key.name == name; });
}

Remedy remedy_with(Word word, std::vector<RemedyAnswer> answers) {
  Remedy made{report::RemedySettings("cpg: {frequency: 1.2, amplitude: 0.6}\nactuator: {u_max: 7.4, i_max: 1.2}\n"
                                     "controller: {Kp: {default: 60, m3/active: 40}}\nduration: 9\n"),
              "0123456789abcdef", word};
  made.answers = std::move(answers);
  return made;
}

Lines lines_of(const Remedy& remedy) {
  Lines lines;
  for (const report::ScreenLine& line : report::remedy_lines(remedy)) lines.push_back(line.text);
  return lines;
}

RemedyAnswer confirmed(const char* name, double factor, double until) {
  RemedyAnswer answer{.key = key_named(name), .up = factor > 1, .crosses = true, .confirmed = true, .factor = factor};
  answer.until = until;
  answer.run.speed = answer.run.margin = std::numeric_limits<double>::quiet_NaN();
  return answer;
}

TEST(RemedyText, StatesTheValueOrHowManyTimesThePresentOneItIs) {
  EXPECT_EQ(lines_of(remedy_with(Word::infeasible, {confirmed("i_max", 1.5, 5)})),
            Lines{"feasible with i_max >= 1.8 A (now 1.2 A)"});
  EXPECT_EQ(lines_of(remedy_with(Word::infeasible, {confirmed("i_max", 1.5, 2.5)})),
            Lines{"feasible with i_max from 1.8 A to 3 A (now 1.2 A)"});
  EXPECT_EQ(lines_of(remedy_with(Word::infeasible, {confirmed("u_max with i_max", 1.388, 5)})),
            Lines{"feasible with u_max and i_max together at least 1.388 times the present value"});
  EXPECT_EQ(lines_of(remedy_with(Word::infeasible, {confirmed("u_max with i_max", 1.388, 2.32)})),
            Lines{"feasible with u_max and i_max together from 1.388 to 2.32 times the present value"});
  EXPECT_EQ(lines_of(remedy_with(Word::infeasible, {confirmed("Kp", 0.5, 0.2)})),
            Lines{"feasible with Kp at most 0.5 times the present value"});
  EXPECT_EQ(lines_of(remedy_with(Word::feasible, {confirmed("u_max with i_max", 0.62, 0.62)})),
            Lines{"stays feasible with u_max and i_max together down to 0.62 times the present value"});
}

TEST(RemedyText, StatesWhyFurtherValuesWereNotTried) {
  RemedyAnswer answer{.key = key_named("amplitude"), .up = true};
  answer.until = 1.993;
  answer.refused = "amplitude is 1.894155107 rad; expected 0 to 1.5 rad";
  answer.refused_at = 3.157;
  EXPECT_EQ(lines_of(remedy_with(Word::infeasible, {answer})),
            Lines{"amplitude is tried only up to 1.196 rad, because 1.894 rad is refused: expected 0 to 1.5 rad"});
  answer.key = key_named("Kp");
  answer.refused = "the joint cannot settle; take 150 or less";
  EXPECT_EQ(lines_of(remedy_with(Word::infeasible, {answer})),
            Lines{"Kp is tried only up to 1.993 times the present value, because 3.157 times the present value is refused: the "
                  "joint cannot settle; take 150 or less"});
}

TEST(RemedyText, NamesSettingsThatDoNotHelp) {
  const auto without = [](const char* name) {
    return std::vector<RemedyAnswer>{{.key = key_named(name)}, {.key = key_named(name), .up = true}};
  };
  std::vector<RemedyAnswer> answers = without("i_max");
  for (const RemedyAnswer& one : without("u_max with i_max")) answers.push_back(one);
  EXPECT_EQ(lines_of(remedy_with(Word::infeasible, answers)),
            Lines{"no i_max or u_max and i_max together from a fifth to five times the present value makes it feasible alone"});
  answers.back().stopped = true;
  Remedy interrupted = remedy_with(Word::infeasible, answers);
  interrupted.interrupted = true;
  interrupted.runs = 7;
  EXPECT_EQ(lines_of(interrupted), (Lines{"no i_max from a fifth to five times the present value makes it feasible alone",
                                          "interrupted after 7 runs, on which the lines above rest; not tried to the end: "
                                          "larger u_max and i_max together"}));
}

TEST(RemedyText, TheFastestGaitComesFirst) {
  RemedyAnswer slow = confirmed("i_max", 1.5, 5), still = confirmed("frequency", 0.5, 0.2), fast = confirmed("u_max", 1.5, 5);
  slow.run.speed = 0.1;
  still.run.speed = 0.01;
  still.run.still = true;
  fast.run.speed = 0.3;
  Remedy made = remedy_with(Word::infeasible, {still, slow, fast});
  EXPECT_EQ(lines_of(made), (Lines{"feasible with u_max >= 11.1 V (now 7.4 V); speed 0.3000 m/s",
                                   "or with i_max >= 1.8 A (now 1.2 A); speed 0.1000 m/s",
                                   "or with frequency <= 0.6 Hz (now 1.2 Hz); speed 0.0100 m/s, hardly moves"}));
}

TEST(RemedyText, NamesWhatDoesNotConfirmAnAnswer) {
  RemedyAnswer answer = confirmed("i_max", 1.5, 5);
  answer.confirmed = false;
  const auto line = [&] { return lines_of(remedy_with(Word::infeasible, {answer})).at(0); };
  EXPECT_TRUE(line().ends_with(": i_max >= 1.8 A (now 1.2 A): next to no change")) << line();
  answer.run.simulated = true;
  answer.run.weakest = "current of m1/active; worst at 2 s";
  EXPECT_TRUE(line().ends_with(": i_max >= 1.8 A (now 1.2 A): current of m1/active")) << line();
  answer.less_suffices = true;
  EXPECT_TRUE(line().ends_with(": i_max >= 1.8 A (now 1.2 A): a smaller change also makes it feasible")) << line();
}

}  // namespace
}  // namespace gaitlab::test
