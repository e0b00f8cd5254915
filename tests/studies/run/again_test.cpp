// Tests of second runs with an estimate of the torque error: their selection, and their rows.
#include "studies/run/again.h"

#include <gtest/gtest.h>

#include "studies/journal/results.h"
#include "studies/study/number.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::Job;
using studies::Row;

TEST(DoAgain, AsksForAnEstimateAndTellsAfterItTook) {
  std::vector<std::string> calls;
  const studies::Again again{
      .count = 3,
      .job =
          [&](std::size_t number) {
            Job job;
            job.row.run = 10 + number;
            return job;
          },
      .take = [&](std::vector<Row>&& rows) { calls.push_back("take " + rows.at(0).message); },
      .told = [&](std::size_t done, std::size_t of) { calls.push_back(std::to_string(done) + " of " + std::to_string(of)); }};
  std::atomic<bool> stop = false;
  const studies::Executor executor = answering([](const Job& job) {
    Row row = job.row;
    row.message = std::to_string(row.run) + (job.estimate ? " with an estimate" : "");
    return row;
  });
  EXPECT_TRUE(studies::do_again(again, executor, stop));
  EXPECT_EQ(calls, (std::vector<std::string>{"0 of 3", "take 10 with an estimate", "1 of 3", "take 11 with an estimate",
                                             "2 of 3", "take 12 with an estimate", "3 of 3"}));
  stop = true;
  EXPECT_FALSE(studies::do_again(again, executor, stop));
  EXPECT_EQ(calls.size(), 8U) << "nothing but the number of runs";
}

TEST(DoAgain, OfNoJobsNeedsNoExecutor) {
  std::atomic<bool> stop = false;
  EXPECT_TRUE(studies::do_again({}, {}, stop));
}

/// A drawn sweep of 200 points of which one in eight is estimated, and its journal.
class DoubtedSweep {
 public:
  explicit DoubtedSweep(const std::string& lines = "estimate_every: 8\n")
      : study(
            "parameters: {cpg.frequency: {low: 0.5, high: 1.5}}\nmethod: {type: random}\nbudget: {runs: 200}\nguards: none\n" +
            lines) {
    for (std::uint64_t run = 0; run < 200; ++run) {
      (study.plan->estimates(study.plan->row(run).point) ? drawn : others).push_back(run);
    }
  }
  /// Writes rows. `error` gives the torque error of drawn runs by their index; NaN is not known.
  std::vector<std::uint64_t> in_doubt(const std::function<double(std::size_t)>& error) {
    studies::Journal journal = study.journal();
    std::vector<Row> rows;
    for (const std::uint64_t run : others)
      rows.push_back(study.done(study.plan->row(run), studies::kTorqueError, std::nan("")));
    for (std::size_t k = 0; k < drawn.size(); ++k)
      rows.push_back(study.done(study.plan->row(drawn[k]), studies::kTorqueError, error(k)));
    rows.at(0).outcome = "diverged";
    failed = rows[0].run;
    std::ranges::sort(rows, {}, &Row::run);
    journal.write(rows, {});
    return studies::runs_in_doubt(*study.plan, journal);
  }
  [[nodiscard]] std::vector<std::uint64_t> others_that_ended() const {
    std::vector<std::uint64_t> all = others;
    std::erase(all, failed);
    return all;
  }
  SmallStudy study;
  std::vector<std::uint64_t> drawn, others;
  std::uint64_t failed = 0;
};

TEST(RunsInDoubt, AreNoneWhereTheEstimatesAreGood) {
  DoubtedSweep sweep;
  ASSERT_GE(sweep.drawn.size(), 10U);
  ASSERT_GE(sweep.others.size(), 100U);
  EXPECT_EQ(sweep.in_doubt([](std::size_t) { return 0.05; }), std::vector<std::uint64_t>{}) << "5 % is accurate";
}

TEST(RunsInDoubt, AreTheOthersWhereMoreThanOneInTenIsInaccurate) {
  DoubtedSweep at_limit;
  const std::size_t tenth = at_limit.drawn.size() / 10;
  EXPECT_TRUE(at_limit.in_doubt([&](std::size_t k) { return k < tenth ? 0.06 : 0.01; }).empty());
  DoubtedSweep beyond;
  EXPECT_EQ(beyond.in_doubt([&](std::size_t k) { return k <= tenth ? 0.06 : 0.01; }), beyond.others_that_ended())
      << "a run that diverged has no torque error";
}

/// The limit is that of the scenario, but at most 10 %.
TEST(RunsInDoubt, AreByTheLimitOfTheScenario) {
  const std::string every = "estimate_every: 8\n";
  const auto of = [](double error) { return [error](std::size_t) { return error; }; };
  EXPECT_TRUE(DoubtedSweep(every + "set: [limits.torque_error=0.07]\n").in_doubt(of(0.06)).empty());
  DoubtedSweep strict(every + "set: [limits.torque_error=0.02]\n");
  EXPECT_EQ(strict.in_doubt(of(0.03)), strict.others_that_ended());
  DoubtedSweep lax(every + "set: [limits.torque_error=1]\n");
  EXPECT_EQ(lax.in_doubt(of(0.11)), lax.others_that_ended());
}

TEST(RunsInDoubt, AreTheOthersWhereTooFewAreEstimated) {
  DoubtedSweep two;
  EXPECT_EQ(two.in_doubt([](std::size_t k) { return k < 2 ? 0.01 : std::nan(""); }), two.others_that_ended());
  DoubtedSweep three;
  EXPECT_TRUE(three.in_doubt([](std::size_t k) { return k < 3 ? 0.01 : std::nan(""); }).empty());
}

/// If the engine gives no estimate, a second run would have none either.
TEST(RunsInDoubt, AreNoneWhereNoDrawnRunHasAnEstimate) {
  EXPECT_TRUE(DoubtedSweep().in_doubt([](std::size_t) { return std::nan(""); }).empty());
}

TEST(RunsInDoubt, AreNoneWhereNobodyWantsAnEstimate) {
  const auto bad = [](std::size_t) { return 1.0; };
  EXPECT_TRUE(DoubtedSweep("estimate_every: 0\n").in_doubt(bad).empty());
  EXPECT_TRUE(DoubtedSweep("estimate_every: 8\nset: [physics.estimate=off]\n").in_doubt(bad).empty());
}

TEST(EstimateAgain, ReplacesTheRowsOfTheseRuns) {
  const SmallStudy study("parameters: {cpg.frequency: {low: 0.5, high: 1.5, count: 3}}\nguards: none\n");
  studies::Journal journal = study.journal();
  std::vector<Row> rows;
  for (std::uint64_t run = 0; run < 3; ++run) rows.push_back(study.done(study.plan->row(run), "speed", 1));
  journal.write(rows, {});
  std::atomic<bool> stop = false;
  std::vector<std::vector<std::string>> sets;
  const studies::Executor executor = answering([&](const Job& job) {
    sets.push_back(job.sets);
    return study.done(job.row, "speed", 2);
  });
  EXPECT_TRUE(studies::estimate_again(*study.plan, journal, {0, 2}, executor, {}, stop));
  EXPECT_EQ(sets, (std::vector<std::vector<std::string>>{{"cpg.frequency=0.5"}, {"cpg.frequency=1.5"}}));
  EXPECT_EQ(journal.rows(), 3U);
  std::vector<std::string> speeds;
  journal.each_row({journal.column_of("speed")}, [&](const std::vector<std::string>& row) { speeds.push_back(row[0]); });
  EXPECT_EQ(speeds, (std::vector<std::string>{"2", "1", "2"}));
}

}  // namespace
}  // namespace gaitlab::test
