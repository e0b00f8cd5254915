// Tests of the results that another program gives: values that are taken, and lines that are refused.
#include "studies/run/told.h"

#include <gtest/gtest.h>

#include <cmath>

#include "studies/run/question.h"
#include "tests/messages.h"

namespace gaitlab::studies {
namespace {

const SourceLocation kPlace{"stdin", 3, 1};

Told told(const std::string& line, std::size_t objectives = 1) { return read_told(line, kPlace, objectives); }

std::string refused(const std::string& line, std::size_t objectives = 1) {
  return test::message_of([&] { (void)told(line, objectives); });
}

TEST(Told, LeastResult) {
  const Told one = told(R"({"id": 7, "objective": 0.25})");
  EXPECT_EQ(one.point, 7U);
  EXPECT_EQ(one.outcome, "done");
  EXPECT_EQ(one.score.objective(), 0.25);
  EXPECT_TRUE(one.score.kept());
  EXPECT_EQ(one.verdict, Word::not_judged);
}

TEST(Told, ReadsWhatAnswerWrites) {
  JournalHead head;
  head.objectives = {{"speed", true}, {"power", false}};
  head.quantities = {{"speed", "m/s", ""}, {"power", "W", ""}, {"margin", "", ""}};
  Brief run{12, "done", "", 1.5, Score{{0.1, 2.5}, 0.75}, Word::infeasible};
  const std::vector<std::vector<std::string>> figures{{"0.1", "2.5", ""}};
  const Told one = told(answer({"12", {}, ""}, head, {}, {&run, 1}, figures), 2);
  EXPECT_EQ(one.point, 12U);
  EXPECT_EQ(one.score.objectives[0], 0.1);
  EXPECT_EQ(one.score.objectives[1], 2.5);
  EXPECT_EQ(one.score.violation, 0.75);
  EXPECT_EQ(one.simulated, 1.5);
  EXPECT_EQ(one.verdict, Word::infeasible);
  EXPECT_EQ(one.quantities.at("power"), 2.5);
  EXPECT_TRUE(std::isnan(one.quantities.at("margin")));
  run.outcome = "diverged";
  const Told failed = told(answer({"12", {}, ""}, head, {}, {&run, 1}, figures), 2);
  EXPECT_EQ(failed.outcome, "diverged");
  EXPECT_EQ(failed.simulated, 1.5);
}

/// The answer for a stopped run has what ran of it; for a search it is a failed point.
TEST(Told, AnswersOfStoppedRunsHaveTheirFigures) {
  JournalHead head;
  head.objectives = {{"speed", true}};
  head.quantities = {{"speed", "m/s", ""}};
  head.combine = "worst";
  const Brief run{12, "stopped", "stopped by hopeless at t = 4 s: fall", 4, Score{{0.1}, 0.75}, Word::failed};
  const std::vector<std::vector<std::string>> figures{{"0.1"}};
  const std::string text = answer({"12", {}, ""}, head, {}, {&run, 1}, figures);
  EXPECT_EQ(text, R"({"id":12,"run":12,"outcome":"stopped","message":"stopped by hopeless at t = 4 s: fall","simulated":4,)"
                  R"("verdict":"failed","figures":{"speed":0.1},"margins":{},"objective":[0.1],"violation":0.75,"kept":false,)"
                  R"("feasible":false})");
  const Told one = told(text);
  EXPECT_EQ(one.outcome, "stopped");
  EXPECT_EQ(one.verdict, Word::failed);
}

TEST(Told, UnknownObjectivesAreViolations) {
  EXPECT_EQ(told(R"({"id": 1, "objective": [null, 1, null]})", 3).score.violation, 2);
  EXPECT_EQ(told(R"({"id": 1, "objective": null, "violation": 0.5})").score.violation, 1);
  EXPECT_EQ(told(R"({"id": 1, "objective": 2, "violation": 0.5})").score.violation, 0.5);
}

TEST(Told, FailedPointsHaveNoScore) {
  const Told one = told(R"({"id": 1, "outcome": "fell", "message": "on its back", "objective": [null]})");
  EXPECT_EQ(one.outcome, "fell");
  EXPECT_EQ(one.message, "on its back");
  EXPECT_EQ(one.verdict, Word::failed);
  EXPECT_EQ(told(R"({"id": 1, "outcome": "fell", "simulated": null})").simulated, 0);
}

TEST(Told, EmptyCellsOfATableAreLeftOut) {
  const Told one = told(R"({"id": 1, "objective": 2, "outcome": null, "message": null, "verdict": null, "figures": null})");
  EXPECT_EQ(one.outcome, "done");
  EXPECT_EQ(one.verdict, Word::not_judged);
  EXPECT_EQ(one.score.objective(), 2);
  const Told empty = told(R"({"id": 1, "objective": 2, "outcome": "", "verdict": ""})");
  EXPECT_EQ(empty.outcome, "done");
  EXPECT_EQ(empty.verdict, Word::not_judged);
}

TEST(Told, FaultyLinesAreRefused) {
  const std::string end = R"(; expected {"id": 7, "objective": 0.031, "violation": 0}, or an answer of gaitlab evaluate)";
  EXPECT_EQ(refused("{"), "stdin:3:2: error: is not JSON" + end);
  EXPECT_EQ(refused("[1]"), "stdin:3:1: error: is not a JSON object" + end);
  EXPECT_EQ(refused(R"({"objective": 1})"), "stdin:3:1: error: has no id" + end);
  EXPECT_EQ(refused(R"({"id": 1})"), "stdin:3:1: error: has no objective" + end);
  EXPECT_EQ(refused(R"({"id": 1, "objective": 1, "value": 2})"), "stdin:3:1: error: unknown key 'value'" + end);
  EXPECT_EQ(refused(R"({"id": -1, "objective": 1})"), "stdin:3:1: error: id is -1; expected the id of a question");
  EXPECT_EQ(refused(R"({"id": 1, "objective": "1"})"), "stdin:3:1: error: objective is \"1\"; expected a number");
  EXPECT_EQ(refused(R"({"id": 1, "objective": 1})", 2), "stdin:3:1: error: objective is 1; expected a list of 2 numbers");
  EXPECT_EQ(refused(R"({"id": 1, "objective": 1, "violation": -1})"),
            "stdin:3:1: error: violation is -1; expected a number, 0 or more");
  EXPECT_EQ(refused(R"({"id": 1, "objective": 1, "verdict": "good"})"),
            "stdin:3:1: error: verdict is \"good\"; expected feasible, infeasible or not judged");
  EXPECT_EQ(refused(R"({"id": 1, "outcome": 3, "objective": 1})"), "stdin:3:1: error: outcome is 3; expected a text");
  EXPECT_EQ(refused(R"({"id": 1, "outcome": "not run"})"),
            "stdin:3:1: error: outcome is \"not run\"; expected no result of this point before it has run");
  EXPECT_EQ(refused(R"({"id": 1, "objective": 1, "figures": {"speed": "x"}})"),
            "stdin:3:1: error: figure speed is \"x\"; expected a number");
  EXPECT_EQ(refused(R"({"id": 1, "objective": 1e999})"), "stdin:3:1: error: holds a number that is too large" + end);
}

}  // namespace
}  // namespace gaitlab::studies
