// Tests of the numbers of points that another program requests, which are the same after every start.
#include "studies/run/asked.h"

#include <gtest/gtest.h>

#include "tests/messages.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::Asked;
using studies::Journal;
using studies::Row;

const std::string kAsked = "parameters: {cpg.frequency: {low: 0.5, high: 1.5}}\nguards: none\n";

/// One start of the program, with a separate plan and an order of requested points.
class AskingProgram {
 public:
  explicit AskingProgram(Journal& journal, const std::string& lines = kAsked)
      : study(lines, studies::Purpose::evaluate), asked(*study.plan, journal) {}
  std::vector<std::uint64_t> numbers(const std::vector<std::string>& frequencies) {
    std::vector<std::uint64_t> all;
    for (const std::string& one : frequencies) all.push_back(asked.point({one}));
    return all;
  }
  [[nodiscard]] Row row(std::uint64_t run) const { return study.done(study.plan->row(run), "speed", 1); }

  SmallStudy study;
  Asked asked;
};

using Numbers = std::vector<std::uint64_t>;

class AskedPoints : public testing::Test {
 protected:
  /// Writes the rows of these runs of a program.
  void write(const AskingProgram& program, const Numbers& runs) {
    std::vector<Row> rows;
    for (const std::uint64_t run : runs) rows.push_back(program.row(run));
    journal_.write(rows, {});
  }
  const SmallStudy of_{kAsked, studies::Purpose::evaluate};
  Journal journal_ = of_.journal();
};

TEST_F(AskedPoints, AreNumberedInTheOrderOfTheirFirstRequest) {
  AskingProgram program(journal_);
  EXPECT_EQ(program.asked.end(), 0U);
  EXPECT_EQ(program.numbers({"0.7", "0.6", "0.7", "1", "0.6"}), (Numbers{0, 1, 0, 2, 1}));
  EXPECT_EQ(program.asked.end(), 3U);
  EXPECT_EQ(program.study.plan->row(2).values, std::vector<std::string>{"1"});
}

TEST_F(AskedPoints, HaveTheirNumbersAgainAfterARestart) {
  AskingProgram first(journal_);
  first.numbers({"0.7", "0.6", "1"});
  write(first, {0, 1, 2});
  AskingProgram again(journal_);
  EXPECT_EQ(again.asked.end(), 0U) << "until they are asked for";
  EXPECT_EQ(again.numbers({"0.7", "0.6"}), (Numbers{0, 1}));
  EXPECT_EQ(again.asked.end(), 2U);
  EXPECT_EQ(again.numbers({"1", "1.2"}), (Numbers{2, 3}));
  for (std::uint64_t run = 0; run < 3; ++run) EXPECT_EQ(again.study.plan->row(run).point, first.study.plan->row(run).point);
}

TEST_F(AskedPoints, OfOtherRequestsFindRowsAndGetFreeNumbers) {
  AskingProgram first(journal_);
  first.numbers({"0.7", "0.6", "1"});
  write(first, {0, 1, 2});
  AskingProgram other(journal_);
  EXPECT_EQ(other.numbers({"1.2", "1", "0.8", "0.7"}), (Numbers{3, 2, 4, 0})) << "no new point gets a number with a row";
  for (const auto& [run, value] : {std::pair{0U, "0.7"}, {1U, "0.6"}, {2U, "1"}, {3U, "1.2"}, {4U, "0.8"}})
    EXPECT_EQ(other.study.plan->row(run).values, std::vector<std::string>{value}) << run;
}

/// The program ended when only runs 1 and 3 had rows. Numbers 0 and 2 are then free for any points.
TEST_F(AskedPoints, FillTheGapsOfAKilledProgram) {
  AskingProgram first(journal_);
  first.numbers({"0.7", "0.6", "1", "0.9"});
  write(first, {1, 3});
  AskingProgram same(journal_);
  EXPECT_EQ(same.numbers({"0.7", "0.6", "1", "0.9"}), (Numbers{0, 1, 2, 3}));
  AskingProgram other(journal_);
  EXPECT_EQ(other.numbers({"0.9", "1.4", "1.3", "1.2"}), (Numbers{3, 0, 2, 4}));
  EXPECT_EQ(other.study.plan->row(1).values, std::vector<std::string>{"0.6"});
}

/// A point that lacks a replicate keeps its number, although not all of its runs have rows.
TEST(AskedReplicates, ThatAreMissingKeepTheNumberOfTheirPoint) {
  const std::string lines = kAsked + "replicates: {count: 2}\n";
  const SmallStudy of(lines, studies::Purpose::evaluate);
  Journal journal = of.journal();
  AskingProgram first(journal, lines);
  first.numbers({"0.7", "0.6"});
  const std::vector<Row> rows{first.row(0), first.row(1), first.row(3)};
  journal.write(rows, {});
  AskingProgram again(journal, lines);
  EXPECT_EQ(again.numbers({"0.7", "0.6", "1"}), (Numbers{0, 1, 2}));
  EXPECT_EQ(again.asked.end(), 6U) << "runs, two of a point";
  AskingProgram other(journal, lines);
  EXPECT_EQ(other.numbers({"0.6"}), Numbers{1});
  EXPECT_EQ(other.asked.end(), 4U) << "run 2 is missing, and will be run";
}

TEST_F(AskedPoints, BeyondTheMostAreRefusedAndOthersStayKnown) {
  AskingProgram program(journal_);
  for (int k = 0; k < SmallStudy::kMostAskedRuns; ++k) program.asked.point({"0." + std::to_string(60 + k)});
  EXPECT_EQ(message_of([&] { program.asked.point({"1.4"}); }), "stdin: error: asks for more than 8 points");
  EXPECT_EQ(program.asked.point({"0.67"}), 7U);
  EXPECT_EQ(program.asked.end(), 8U);
}

}  // namespace
}  // namespace gaitlab::test
