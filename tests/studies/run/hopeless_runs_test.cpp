// Tests of hopeless runs: the studies that stop them, and the rows and points that they give.
#include <gtest/gtest.h>

#include <bit>
#include <utility>

#include "studies/journal/results.h"
#include "studies/search/fitness.h"
#include "tests/messages.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::Brief;
using studies::Job;
using studies::Row;

// With 1 V the motors are at the limit of their voltage nearly all the time.
const std::string kWeakMotors = "set: [contact.on=all, duration=6, physics.estimate=off, actuator.u_max=1, cpg.frequency=1]\n";
const std::string kWeakSearch = "parameters: {cpg.phase_lag: {low: 0.5, high: 1.5}}\nbudget: {runs: 16}\n";
const std::string kWeakGrid = "parameters: {cpg.phase_lag: {low: 0.5, high: 1.5, count: 3}}\n";

/// The row of one run.
Row executed_row(const SmallStudy& study, const Job& job) {
  std::optional<Job> next = job;
  std::vector<Row> rows;
  const studies::Work work{.next = [&] { return std::exchange(next, std::nullopt); },
                           .begin = [](std::span<const std::uint64_t>) {},
                           .end = [&](std::vector<Row>&& ended) { rows = std::move(ended); }};
  std::atomic<bool> stop = false;
  const studies::Measure measure = app::quantity_measure(study.plan->columns(), study.plan->scenario());
  EXPECT_TRUE(studies::local_executor(*study.plan, {.threads = 1}, measure)(work, stop));
  EXPECT_EQ(rows.size(), 1U);
  return rows.empty() ? Row() : rows.front();
}

/// The row of the first point of a search with these lines.
Row searched_row(const std::string& lines, bool whole = false) {
  SmallStudy study(kWeakSearch + lines, studies::Purpose::optimize);
  study.plan->add({"1"});
  Job job = study.job(0);
  job.whole = whole;
  return executed_row(study, job);
}

TEST(HopelessRuns, AreStoppedInSearchesAndKeepWhatRan) {
  const SmallStudy study(kWeakSearch + kWeakMotors, studies::Purpose::optimize);
  EXPECT_TRUE(contains(studies::definition(study.plan->bound()), "\nstop: hopeless\n"));
  const Row row = searched_row(kWeakMotors);
  EXPECT_EQ(row.outcome, "stopped");
  EXPECT_TRUE(row.message.starts_with("stopped by hopeless at t = ")) << row.message;
  EXPECT_TRUE(contains(row.message, " s: voltage of m")) << row.message;
  EXPECT_EQ(row.verdict, Word::failed);
  EXPECT_GE(row.simulated, 3) << "after two periods";
  EXPECT_LT(row.simulated, 6);
  ASSERT_EQ(row.quantities.size(), study.plan->columns().size());
  EXPECT_EQ(row.quantities[study.column("simulated")], row.simulated);
  EXPECT_LT(row.quantities[study.column("margin.voltage")], -4);
  EXPECT_EQ(row.quantities[study.column("feasible")], 0);
  ASSERT_TRUE(row.score.has_value());
  EXPECT_TRUE(std::isfinite(row.score->objective()));
  EXPECT_GT(row.score->violation, 0.5);
}

TEST(HopelessRuns, ContinueWhereNothingStopsThem) {
  EXPECT_EQ(searched_row(kWeakMotors + "stop: none\n").outcome, "done");
  EXPECT_EQ(searched_row(kWeakMotors + "stop: [simulated > 100]\n").outcome, "done") << "a stated list replaces the default";
  EXPECT_EQ(searched_row(kWeakMotors + "guards: none\n").outcome, "done");
  EXPECT_EQ(searched_row(kWeakMotors, true).outcome, "done") << "evidence for a verification";
  const SmallStudy grid(kWeakGrid + kWeakMotors);
  EXPECT_FALSE(contains(studies::definition(grid.plan->bound()), "stop: "));
  EXPECT_EQ(executed_row(grid, grid.job(1)).outcome, "done");
}

TEST(HopelessRuns, AreStoppedInAGridThatAsksForIt) {
  const SmallStudy grid(kWeakGrid + kWeakMotors + "stop: [fell, hopeless]\n");
  EXPECT_EQ(executed_row(grid, grid.job(1)).outcome, "stopped");
}

/// Checks that the study ignores, and limits that it raises, do not stop a run.
TEST(HopelessRuns, AreThoseOfTheStudysGuards) {
  EXPECT_EQ(searched_row(kWeakMotors + "guards: {voltage: false, current: false, tracking: false, stops: false}\n").outcome,
            "done");
  const Row row = searched_row(kWeakMotors + "guards: {voltage: {margin: -1000}, current: false, tracking: 9, stops: false}\n");
  EXPECT_EQ(row.outcome, "done") << row.message;
}

/// A CPG that states no period may change its set points later: the first 4 s, at the limit of the voltage, decide nothing.
TEST(HopelessRuns, AreNoneWhereTheGaitMayChange) {
  const std::string late =
      "parameters: {controller.Kp: {low: 50, high: 100}}\nbudget: {runs: 16}\n"
      "set: [contact.on=all, duration=8, physics.estimate=off, actuator.u_max=2, "
      "'cpg={type: equations, model: {states: {g: 1}, initial: {g: 0}, output: \"if(g < 4, 0.8, 0.1)*sin(6.2831853*g)\"}}']\n";
  SmallStudy study(late, studies::Purpose::optimize);
  study.plan->add({"60"});
  const Row row = executed_row(study, study.job(0));
  EXPECT_EQ(row.outcome, "done") << row.message;
}

/// The rule changes no bit of a run that it does not stop.
TEST(HopelessRuns, LeaveOthersAsTheyAre) {
  const std::string gentle = "set: [contact.on=all, duration=4, physics.estimate=off, cpg.frequency=1, cpg.amplitude=0.1]\n";
  const Row with = searched_row(gentle);
  const Row without = searched_row(gentle + "stop: none\n");
  ASSERT_EQ(with.outcome, "done") << with.message;
  ASSERT_EQ(with.quantities.size(), without.quantities.size());
  EXPECT_EQ(with.message, without.message);
  for (std::size_t k = 0; k < with.quantities.size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(with.quantities[k]), std::bit_cast<std::uint64_t>(without.quantities[k])) << k;
}

/// A search ranks the point of a stopped run like a completed one that breaks limits. A point that may have broken runs counts
/// the stopped run as failed, and so does a stopped run that breaks no limit.
TEST(HopelessRuns, CountByWhatRan) {
  const SmallStudy study(kWeakSearch, studies::Purpose::optimize);
  studies::JournalHead head = studies::journal_head(*study.plan);
  Brief run{0, "stopped", "stopped by hopeless at t = 4 s: fall", 4, studies::Score{{0.25}, 0.75}, Word::failed};
  const studies::PointResult point = studies::point_result(head, {&run, 1});
  EXPECT_EQ(point.failed, 0U);
  EXPECT_EQ(point.stopped, 1U);
  EXPECT_FALSE(point.kept());
  const studies::Rating rating = studies::rating(point, head.objectives, 6);
  EXPECT_EQ(rating.objective, -0.25);
  EXPECT_EQ(rating.violation, 0.75);
  head.combine = "median";
  EXPECT_EQ(studies::point_result(head, {&run, 1}).failed, 1U);
  head.combine = "worst";
  run.score.reset();
  EXPECT_EQ(studies::point_result(head, {&run, 1}).failed, 1U);
}

}  // namespace
}  // namespace gaitlab::test
