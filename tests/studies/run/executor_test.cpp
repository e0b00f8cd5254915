// Tests of the executor of this process, which gives a row for each job, even for a failed one.
#include "studies/run/executor.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>

#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::Job;
using studies::Row;

const std::string kThreeFrequencies = "parameters: {cpg.frequency: {low: 0.5, high: 1.5, count: 3}}\nguards: none\n";

/// Jobs done by the executor, and the calls that it made.
struct ExecutedJobs {
  ExecutedJobs(const SmallStudy& study, std::vector<Job> jobs, int threads = 1) {
    const studies::Measure measure{[&](const Scenario& scenario, const Recording& recording) {
                                     const std::lock_guard lock(mutex);
                                     estimate = scenario.physics.estimate;
                                     estimated_by_others = scenario.physics.estimated_by_others;
                                     studies::RunMeasured measured;
                                     measured.quantities.assign(study.plan->columns().size(), recording.simulated);
                                     measured.verdict = Word::feasible;
                                     measured.why = "why";
                                     return measured;
                                   },
                                   Loads::left_out};
    std::size_t next = 0;
    const studies::Work work{
        .next = [&]() -> std::optional<Job> { return next < jobs.size() ? std::optional(jobs[next++]) : std::nullopt; },
        .begin = [&](std::span<const std::uint64_t> runs) { begun.insert(begun.end(), runs.begin(), runs.end()); },
        .end =
            [&](std::vector<Row>&& ended) {
              const std::lock_guard lock(mutex);
              EXPECT_TRUE(std::ranges::is_sorted(ended, {}, &Row::run));
              for (Row& row : ended) {
                EXPECT_FALSE(rows.contains(row.run)) << "twice";
                rows[row.run] = std::move(row);
              }
            }};
    whole = studies::local_executor(*study.plan, {.threads = threads}, measure)(work, stop);
  }

  std::mutex mutex;
  std::atomic<bool> stop = false;
  bool whole = false;
  std::vector<std::uint64_t> begun;
  std::map<std::uint64_t, Row> rows;
  std::optional<Estimate> estimate;
  bool estimated_by_others = false;
};

TEST(LocalExecutor, GivesARowForEachJob) {
  const SmallStudy study(kThreeFrequencies);
  for (const int threads : {1, 2}) {
    ExecutedJobs of(study, {study.job(2), study.job(0), study.job(1)}, threads);
    EXPECT_TRUE(of.whole);
    std::ranges::sort(of.begun);
    EXPECT_EQ(of.begun, (std::vector<std::uint64_t>{0, 1, 2}));
    ASSERT_EQ(of.rows.size(), 3U);
    for (const auto& [run, row] : of.rows) {
      const Row known = study.plan->row(run);
      EXPECT_EQ(row.point, known.point);
      EXPECT_EQ(row.values, known.values);
      EXPECT_EQ(row.outcome, "done") << row.message;
      EXPECT_NEAR(row.simulated, 0.02, 1e-12);
      EXPECT_EQ(row.verdict, Word::feasible);
      EXPECT_EQ(row.message, "why");
      ASSERT_EQ(row.quantities.size(), study.plan->columns().size());
      EXPECT_EQ(row.quantities[0], row.simulated) << "of its own recording";
      EXPECT_TRUE(row.score.has_value());
    }
  }
}

/// A scenario that is refused with its values never begins, and the others continue, also after a hundred refusals.
TEST(LocalExecutor, GivesARowForEachRefusedScenario) {
  const SmallStudy study(kThreeFrequencies);
  std::vector<Job> jobs{study.job(0)};
  for (std::uint64_t run = 1; run <= 100; ++run) {
    jobs.push_back(study.job(1));
    jobs.back().row.run = run;
    jobs.back().sets = {"cpg.frequency=-1"};
  }
  jobs.push_back(study.job(2));
  jobs.back().row.run = 101;
  const ExecutedJobs of(study, jobs);
  EXPECT_TRUE(of.whole);
  EXPECT_EQ(of.rows.size(), 102U);
  EXPECT_EQ(of.begun.size(), 2U);
  for (const auto& [run, row] : of.rows) {
    const bool runs = run == 0 || run == 101;
    EXPECT_EQ(row.outcome, runs ? "done" : "refused") << run;
    EXPECT_EQ(row.verdict, runs ? Word::feasible : Word::failed);
    if (!runs) {
      EXPECT_EQ(row.message, "frequency is -1 Hz; expected 0 to 20 Hz");
      EXPECT_FALSE(row.score.has_value());
      EXPECT_TRUE(row.quantities.empty());
    }
  }
}

/// The search's seed draws no point for an estimate. Only jobs that request an estimate have one; the rows of others state that
/// they have none.
TEST(LocalExecutor, EstimatesTheTorqueErrorOfJobsThatAskForIt) {
  SmallStudy study("parameters: {cpg.frequency: {low: 0.5, high: 1.5}}\nbudget: {runs: 16}\nestimate_every: 1000000000\n",
                   studies::Purpose::optimize);
  study.plan->add({"0.75"});
  for (const bool asks : {false, true}) {
    Job job = study.job(0);
    job.estimate = asks;
    const ExecutedJobs of(study, {job});
    ASSERT_EQ(of.rows.at(0).outcome, "done");
    EXPECT_EQ(of.estimate, asks ? Estimate::full : Estimate::off);
    EXPECT_EQ(of.estimated_by_others, !asks);
  }
}

/// The torque error is then estimated at no point.
TEST(LocalExecutor, EstimatesNoTorqueErrorOfAScenarioThatTurnsItOff) {
  SmallStudy study(
      "parameters: {cpg.frequency: {low: 0.5, high: 1.5}}\nbudget: {runs: 16}\nestimate_every: 1000000000\nset: "
      "[physics.estimate=off]\n",
      studies::Purpose::optimize);
  study.plan->add({"0.75"});
  for (const bool asks : {false, true}) {
    Job job = study.job(0);
    job.estimate = asks;
    const ExecutedJobs of(study, {job});
    EXPECT_EQ(of.estimate, Estimate::off);
    EXPECT_FALSE(of.estimated_by_others);
  }
}

TEST(LocalExecutor, DoesNothingWhenItIsStopped) {
  const SmallStudy study(kThreeFrequencies);
  std::atomic<bool> stop = true;
  const auto never = [](const char* what) { ADD_FAILURE() << what; };
  const studies::Work work{.next = [&]() -> std::optional<Job> {
                             never("next");
                             return {};
                           },
                           .begin = [&](std::span<const std::uint64_t>) { never("begin"); },
                           .end = [&](std::vector<Row>&&) { never("end"); }};
  EXPECT_FALSE(studies::local_executor(*study.plan, {}, {})(work, stop));
}

/// A rule of the study ends the run at a whole second. The row states which rule.
TEST(LocalExecutor, StopsARunByTheStudysRules) {
  const SmallStudy study(kThreeFrequencies + "set: [duration=1.5, physics.estimate=off]\nstop: [simulated > 0.9 after 1]\n");
  const ExecutedJobs of(study, {study.job(0)});
  const Row& row = of.rows.at(0);
  EXPECT_EQ(row.outcome, "stopped");
  EXPECT_EQ(row.message, "stopped by simulated > 0.9 after 1 at t = 1 s");
  EXPECT_EQ(row.verdict, Word::failed);
  EXPECT_NEAR(row.simulated, 1, 1e-9);
}

}  // namespace
}  // namespace gaitlab::test
