// Tests of shards of a study: the shard that each task of a Slurm array simulates, and merging of their journals.
#include "studies/journal/database.h"
#include "tests/app/study_fixture.h"

namespace gaitlab::test {
namespace {

const std::string kSweep = "sweep two.yaml --grid cpg.phase_lag=0.5:1.5:6 --out s --quiet --shard ";

class Shard : public StudyFixture {
 protected:
  [[nodiscard]] bool has(const std::string& shard) { return std::filesystem::exists(folder_ / ("s/shards/" + shard + ".db")); }
  void task(const std::string& id, const std::string& first, const std::string& count, const std::string& step, int code = 0,
            const std::string& message = "") {
    const Environment array({{"SLURM_ARRAY_TASK_ID", id},
                             {"SLURM_ARRAY_TASK_MIN", first},
                             {"SLURM_ARRAY_TASK_COUNT", count},
                             {"SLURM_ARRAY_TASK_STEP", step}});
    const Result result = call(kSweep + "auto");
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_EQ(result.err, code == 0 ? "" : message + "\n");
  }
};

TEST_F(Shard, OfAnArrayAreItsTasksInOrder) {
  task("9", "1", "3", "4");  // --array=1-9:4
  EXPECT_TRUE(has("2-of-3"));
  task("1", "1", "3", "4");
  EXPECT_TRUE(has("0-of-3"));
  const Result part = call("study merge s");
  EXPECT_EQ(part.code, 1);
  EXPECT_EQ(part.out, "s/study.db: 4 of 6 runs\n");
  EXPECT_EQ(part.err, "s: error: 1 of 3 shards are missing or incomplete; run them again: --array=1\n");
  task("1", "1", "1", "1");  // sbatch --array=1 repeats one task; the numbers follow from the existing shards
  EXPECT_TRUE(has("1-of-3"));
  for (int k = 0; k < 2; ++k) {
    const Result whole = call("study merge s");
    EXPECT_EQ(whole.code, 0) << whole.err;
    EXPECT_EQ(whole.out, "s/study.db: 6 of 6 runs\n");
  }
  task("7", "3", "2", "4", 2, "--shard auto: error: task 7 is not one of the 3 shards in s");
}

TEST_F(Shard, OfAnArrayNeedWhatSlurmSets) {
  refused(kSweep + "auto",
          "--shard auto: error: SLURM_ARRAY_TASK_ID is not set; a Slurm array sets it\n"
          "--shard auto: error: SLURM_ARRAY_TASK_MIN is not set; a Slurm array sets it\n"
          "--shard auto: error: SLURM_ARRAY_TASK_COUNT is not set; a Slurm array sets it");
  task("x", "0", "2", "1", 2, "--shard auto: error: SLURM_ARRAY_TASK_ID is 'x'; expected a number");
  const std::string expected = "; expected an array A-B or A-B:STEP, or some tasks of an array whose shards are in the folder";
  task("17", "3", "2", "1", 2, "--shard auto: error: task 17 is not one of an array of 2 from 3 in steps of 1" + expected);
  task("2", "3", "2", "1", 2, "--shard auto: error: task 2 is not one of an array of 2 from 3 in steps of 1" + expected);
  task("4", "3", "2", "2", 2, "--shard auto: error: task 4 is not one of an array of 2 from 3 in steps of 2" + expected);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "s"));
}

TEST_F(Shard, ThatAreDamagedOrOthersAreRefusedAndNothingIsLost) {
  for (const char* shard : {"0/3", "1/3", "2/3"}) ASSERT_EQ(call(kSweep + shard).code, 0);
  const std::string middle = folder_ / "s/shards/1-of-3.db";
  const std::string kept = folder_ / "kept.db";
  std::filesystem::copy(middle, kept);
  std::filesystem::resize_file(middle, std::filesystem::file_size(middle) / 2);
  const Result cut = call("study merge s");
  EXPECT_EQ(cut.code, 2);
  EXPECT_TRUE(contains(cut.err, "s/shards/1-of-3.db: error: is damaged: ")) << cut.err;
  const Result again = call(kSweep + "1/3");
  EXPECT_EQ(again.code, 2);
  EXPECT_TRUE(contains(again.err, "s/shards/1-of-3.db: error: is damaged: ")) << again.err;

  folder_.write("s/shards/1-of-3.db", "this is not a database, but a text of more than sixteen bytes");
  refused("study merge s", "s/shards/1-of-3.db: error: is not a database of SQLite");

  ASSERT_EQ(call("sweep two.yaml --grid cpg.phase_lag=0.5:1.6:6 --out t --quiet --shard 1/3").code, 0);
  std::filesystem::copy_file(folder_ / "t/shards/1-of-3.db", middle, std::filesystem::copy_options::overwrite_existing);
  refused("study merge s", "s/shards/1-of-3.db: error: is a journal of another study than s/study.db");

  std::filesystem::copy_file(kept, middle, std::filesystem::copy_options::overwrite_existing);
  studies::Database(middle, studies::Database::Mode::write).execute("UPDATE study SET build = 'another'");
  const Result build = call("study merge s");
  EXPECT_EQ(build.code, 2);
  EXPECT_TRUE(contains(build.err, "s/shards/1-of-3.db: error: was written by another build than s/study.db: another, and "))
      << build.err;

  std::filesystem::remove(middle);
  EXPECT_EQ(call("study merge s").out, "s/study.db: 4 of 6 runs\n");
  std::filesystem::copy_file(kept, middle);
  EXPECT_EQ(call("study merge s").out, "s/study.db: 6 of 6 runs\n");

  ASSERT_EQ(call("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:6 --out t2 --quiet --shard 0/2").code, 0);
  std::filesystem::copy(folder_ / "t2/shards/0-of-2.db", folder_ / "s/shards/0-of-2.db");
  refused("study merge s",
          "s/shards: error: holds shards of a division into 2 and of one into 3; expected the shards of one "
          "division");
}

// If shards have different budgets, the largest budget counts, in any order of the shards.
TEST_F(Shard, OfASmallerBudgetAreNotWhole) {
  folder_.write("study.yaml",
                "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.phase_lag: {low: 0, high: 1}}\n"
                "method: {type: random}\nbudget: {runs: 8}\n");
  ASSERT_EQ(call("sweep study.yaml --out s --quiet --shard 0/2").code, 0);
  ASSERT_EQ(call("sweep study.yaml --out s --quiet --shard 1/2 --runs 12").code, 0);
  const Result part = call("study merge s");
  EXPECT_EQ(part.code, 1);
  EXPECT_EQ(part.out, "s/study.db: 10 of 12 runs\n");
  EXPECT_EQ(part.err, "s: error: 1 of 2 shards are missing or incomplete; run them again: --array=0\n");
  ASSERT_EQ(call("sweep study.yaml --out s --quiet --shard 0/2 --runs 12").code, 0);
  EXPECT_EQ(call("study merge s").out, "s/study.db: 12 of 12 runs\n");
}

TEST_F(Shard, CopiesThatDoNotKnowOfOneAnotherAreRefused) {
  folder_.write("study.yaml", "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.phase_lag: {low: 0, high: 1}}\n");
  const Environment three(std::map<std::string, std::string>{{"OMPI_COMM_WORLD_SIZE", "3"}});
  const std::string expected =
      ": error: was started 3 times side by side (OMPI_COMM_WORLD_SIZE); expected once, as gaitlab-mpi under mpirun, or once "
      "per "
      "shard with sweep --shard";
  refused("sweep two.yaml --grid cpg.phase_lag=1:2:3 --out s", "gaitlab sweep" + expected);
  refused("evaluate study.yaml --out s", "gaitlab evaluate" + expected);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "s"));
}

}  // namespace
}  // namespace gaitlab::test
