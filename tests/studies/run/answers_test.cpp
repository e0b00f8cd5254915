// Tests of results without a run: points that are requested twice, and rows of another study's journal.
#include "studies/run/answers.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/messages.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::Answers;
using studies::Job;
using studies::Journal;
using studies::Row;

/// Jobs of points a, b, c ..., and the calls of an executor that remembers.
class RememberedJobs {
 public:
  explicit RememberedJobs(std::string points) : points_(std::move(points)) {}
  [[nodiscard]] studies::Work work() {
    return {.next = [this]() -> std::optional<Job> {
              if (given_ == points_.size()) return {};
              Job job;
              job.row.point = points_[given_];
              job.row.run = given_++;
              return job;
            },
            .begin = [](std::span<const std::uint64_t>) {},
            .end =
                [this](std::vector<Row>&& ended) {
                  EXPECT_FALSE(ended.empty());
                  for (const Row& row : ended) {
                    EXPECT_FALSE(rows.contains(row.run)) << "twice";
                    rows[row.run] = row;
                  }
                }};
  }
  std::map<std::uint64_t, Row> rows;

 private:
  std::string points_;
  std::uint64_t given_ = 0;
};

/// The row of a run whose message names the point and the run that was simulated.
Row simulated(const Job& job) {
  Row row = job.row;
  row.outcome = "done";
  row.message = row.point + " by run " + std::to_string(row.run);
  return row;
}

TEST(Remembering, RunsEqualPointsOnce) {
  std::vector<Answers> none;
  std::vector<std::uint64_t> run;
  const studies::Executor executor = studies::remembering(answering([&](const Job& job) {
                                                            run.push_back(job.row.run);
                                                            return simulated(job);
                                                          }),
                                                          none);
  RememberedJobs jobs("abaacb");
  std::atomic<bool> stop = false;
  const studies::Work work = jobs.work();
  EXPECT_TRUE(executor(work, stop));
  EXPECT_EQ(run, (std::vector<std::uint64_t>{0, 1, 4}));
  const std::vector<std::string> messages{"a by run 0", "b by run 1", "a by run 0", "a by run 0", "c by run 4", "b by run 1"};
  ASSERT_EQ(jobs.rows.size(), 6U);
  for (const auto& [number, row] : jobs.rows) {
    EXPECT_EQ(row.message, messages[number]) << number;
    EXPECT_EQ(row.run, number);
  }
}

/// All jobs are taken before the first one ends, as in lanes side by side. Equal jobs wait for its result.
TEST(Remembering, EqualPointsWaitForTheOneThatRuns) {
  std::vector<Answers> none;
  std::size_t run = 0;
  const studies::Executor executor = studies::remembering(
      [&](const studies::Work& work, std::atomic<bool>&) {
        std::vector<Row> all;
        while (const std::optional<Job> job = work.next()) all.push_back(simulated(*job));
        run = all.size();
        for (const std::size_t k : {1U, 0U}) work.end({all[k]});  // the jobs may end in any order
        return true;
      },
      none);
  RememberedJobs jobs("aabab");
  std::atomic<bool> stop = false;
  const studies::Work work = jobs.work();
  EXPECT_TRUE(executor(work, stop));
  EXPECT_EQ(run, 2U);
  ASSERT_EQ(jobs.rows.size(), 5U);
  EXPECT_EQ(jobs.rows.at(3).message, "a by run 0");
  EXPECT_EQ(jobs.rows.at(4).message, "b by run 2");
}

TEST(Remembering, TellsReplicatesSeedsAndScenariosApart) {
  std::vector<Answers> none;
  std::size_t run = 0;
  const studies::Executor executor = studies::remembering(answering([&](const Job& job) {
                                                            ++run;
                                                            return simulated(job);
                                                          }),
                                                          none);
  std::vector<Job> jobs(5);
  for (std::size_t k = 0; k < jobs.size(); ++k) jobs[k].row.run = k;
  jobs[1].row.replicate = 1;
  jobs[2].row.seed = 1;
  jobs[3].row.scenario = "rubble";
  std::size_t next = 0;
  std::size_t rows = 0;
  const studies::Work work{
      .next = [&]() -> std::optional<Job> { return next < jobs.size() ? std::optional(jobs[next++]) : std::nullopt; },
      .begin = [](std::span<const std::uint64_t>) {},
      .end = [&](std::vector<Row>&& ended) { rows += ended.size(); }};
  std::atomic<bool> stop = false;
  EXPECT_TRUE(executor(work, stop));
  EXPECT_EQ(run, 4U) << "the last is the first again";
  EXPECT_EQ(rows, 5U);
}

const std::string kRange = "parameters: {cpg.frequency: {low: 0.5, high: 1.5, count: ";

/// Journal of a grid of three points; the second diverged.
class OtherStudy {
 public:
  OtherStudy() {
    Journal journal = study.journal();
    std::vector<Row> rows;
    for (std::uint64_t run = 0; run < 3; ++run)
      rows.push_back(study.done(study.plan->row(run), "speed", 0.25 * static_cast<double>(run)));
    rows[1].outcome = "diverged";
    rows[1].message = "diverged at step 3";
    rows[1].verdict = Word::failed;
    rows[1].score.reset();
    rows[1].quantities.clear();
    journal.write(rows, {});
  }
  /// "no error", or why the journal cannot answer this study, without the folder.
  [[nodiscard]] std::string refused(const SmallStudy& by, Journal::Build taken = Journal::Build::same,
                                    const std::string& build = "a build", const std::string& file = "study.db") const {
    std::string text = message_of([&] { const Answers answers(*by.plan, study.folder / file, build, taken); });
    const std::string path = study.folder.path().string() + "/";
    if (const std::size_t at = text.find(path); at != std::string::npos) text.erase(at, path.size());
    return text;
  }
  SmallStudy study{kRange + "3}}\nguards: none\n"};
};

/// The points 0.5, 1 and 1.5 of the other study are 0, 2 and 4 of this one, which has another objective.
TEST(AnswersOfAnotherStudy, AreRowsOfEqualPointsWithThisStudysScore) {
  const OtherStudy other;
  const SmallStudy study(kRange + "5}}\nguards: none\nobjective: {minimize: 3*speed}\n");
  Answers answers(*study.plan, other.study.folder.path(), "a build", Journal::Build::same);
  for (const std::uint64_t run : {1U, 3U}) EXPECT_FALSE(answers.find(study.plan->row(run)).has_value()) << run;
  const std::optional<Row> last = answers.find(study.plan->row(4));
  ASSERT_TRUE(last.has_value());
  EXPECT_EQ(last->run, 4U) << "this study's number";
  EXPECT_EQ(last->outcome, "done");
  EXPECT_EQ(last->verdict, Word::feasible);
  EXPECT_EQ(last->simulated, 0.02);
  EXPECT_EQ(last->quantities.at(study.column("speed")), 0.5);
  EXPECT_TRUE(std::isnan(last->quantities.at(study.column("torque.peak")))) << "unknown there";
  EXPECT_EQ(last->score.value().objective(), 1.5);
  const std::optional<Row> failed = answers.find(study.plan->row(2));
  ASSERT_TRUE(failed.has_value());
  EXPECT_EQ(failed->outcome, "diverged");
  EXPECT_EQ(failed->message, "diverged at step 3");
  EXPECT_FALSE(failed->score.has_value());
}

TEST(AnswersOfAnotherStudy, AreOfTheSameSeedReplicateAndValues) {
  const OtherStudy other;
  const SmallStudy study(kRange + "3}}\nguards: none\n");
  Answers answers(*study.plan, other.study.folder.path(), "a build", Journal::Build::same);
  const Row row = study.plan->row(0);
  ASSERT_TRUE(answers.find(row).has_value());
  for (const std::string change : {"seed", "replicate", "scenario", "value", "point", "fewer values"}) {
    Row changed = row;
    if (change == "seed") ++changed.seed;
    if (change == "replicate") ++changed.replicate;
    if (change == "scenario") changed.scenario = "rubble";
    if (change == "value") changed.values[0] = "0.50001";  // a forged name of a point
    if (change == "point") changed.point = "0123";
    if (change == "fewer values") changed.values.clear();
    EXPECT_FALSE(answers.find(changed).has_value()) << change;
  }
}

TEST(AnswersOfAnotherStudy, AreTakenBeforeAnyRunAndCounted) {
  const OtherStudy other;
  const SmallStudy study(kRange + "5}}\nguards: none\n");
  std::vector<Answers> answers;
  answers.emplace_back(*study.plan, other.study.folder.path(), "a build", Journal::Build::same);
  std::uint64_t taken = 0;
  std::vector<std::uint64_t> run;
  const studies::Executor executor = studies::remembering(answering([&](const Job& job) {
                                                            run.push_back(job.row.run);
                                                            return simulated(job);
                                                          }),
                                                          answers, &taken);
  std::uint64_t next = 0;
  std::map<std::uint64_t, Row> rows;
  const studies::Work work{
      .next = [&]() -> std::optional<Job> { return next < 5 ? std::optional(study.job(next++)) : std::nullopt; },
      .begin = [](std::span<const std::uint64_t>) {},
      .end =
          [&](std::vector<Row>&& ended) {
            for (Row& row : ended) rows[row.run] = std::move(row);
          }};
  std::atomic<bool> stop = false;
  EXPECT_TRUE(executor(work, stop));
  EXPECT_EQ(taken, 3U);
  EXPECT_EQ(run, (std::vector<std::uint64_t>{1, 3}));
  EXPECT_EQ(rows.size(), 5U);
}

TEST(AnswersOfAnotherStudy, AreNoneOfAnotherScenario) {
  const OtherStudy other;
  const SmallStudy study(kRange + "3}}\nguards: none\nset: [physics.accuracy=0.02]\n");
  Answers answers(*study.plan, other.study.folder.path(), "a build", Journal::Build::same);
  for (std::uint64_t run = 0; run < 3; ++run) EXPECT_FALSE(answers.find(study.plan->row(run)).has_value());
}

/// Rows of runs that were stopped as hopeless are taken only if this study would stop them; completed runs always.
TEST(AnswersOfAnotherStudy, LeaveOutHopelessRunsOfOtherGuards) {
  const SmallStudy other(kRange + "3}}\nstop: [hopeless]\n");
  Journal journal = other.journal();
  std::vector<Row> rows{other.done(other.plan->row(0), "speed", 0.5), other.done(other.plan->row(1), "speed", 0.25)};
  rows[1].outcome = "stopped";
  rows[1].message = "stopped by hopeless at t = 4 s: fall";
  rows[1].verdict = Word::failed;
  journal.write(rows, {});
  const auto answer = [&](const std::string& lines, std::uint64_t run) {
    const SmallStudy study(kRange + "3}}\n" + lines);
    return Answers(*study.plan, other.folder.path(), "a build", Journal::Build::same).find(study.plan->row(run));
  };
  for (const char* lines : {"stop: [hopeless]\n", "", "stop: [hopeless]\nguards: {voltage: false}\n"})
    EXPECT_TRUE(answer(lines, 0).has_value()) << lines;
  const std::optional<Row> stopped = answer("stop: [hopeless]\n", 1);
  ASSERT_TRUE(stopped.has_value());
  EXPECT_EQ(stopped->message, rows[1].message);
  EXPECT_EQ(stopped->score->objective(), 0.25);
  EXPECT_FALSE(stopped->score->kept());
  EXPECT_FALSE(answer("", 1).has_value());
  EXPECT_FALSE(answer("stop: [hopeless]\nguards: {voltage: false}\n", 1).has_value());
}

TEST(AnswersOfAnotherStudy, AreRefusedWhereTheyMayDiffer) {
  const OtherStudy other;
  EXPECT_EQ(other.refused(other.study, Journal::Build::same, "this build"),
            "study.db: error: was written by another build, which may give other numbers: a build, and this is this build; use "
            "its answers anyway with --accept-build");
  EXPECT_EQ(other.refused(other.study, Journal::Build::any, "this build"), kNoError);
  EXPECT_EQ(other.refused(SmallStudy(kRange + "3}}\nguards: none\nstop: [fell]\n")),
            "study.db: error: is of a study with other rules for stopping runs; its runs may have ended at other times");
  EXPECT_EQ(other.refused(SmallStudy(kRange + "3}}\nguards: none\nobjective: {minimize: \"torque.peak[m0/active]\"}\n")),
            "study.db: error: lacks the quantity 'torque.peak[m0/active]', which this study needs");
  EXPECT_EQ(other.refused(other.study, Journal::Build::same, "a build", "none.db"),
            "none.db: error: does not exist; expected the study.db of a study");
}

}  // namespace
}  // namespace gaitlab::test
