// Tests of `gaitlab optimize`: verification of the best points, exit codes, words as parameters, other commands for a search.
#include "studies/journal/journal.h"
#include "studies/search/verify.h"
#include "studies/search/world_trials.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongOptimize(
    "Optimize.TakesAnswersOfOtherStudies:Optimize.WhatChangesWithTheStepIsNotVerified:Optimize.ABestThatStandsHasItsFolder",
    "long");

class Optimize : public ::testing::Test {
 protected:
  Optimize() {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    folder_.write("two.yaml",
                  "gaitlab: 1\nname: two\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\n"
                  "physics: {engine: articulated, step: 0.001}\ncpg: {type: phase_oscillator, frequency: 1}\n"
                  "trace: {period: 0.015}\nduration: 3\n");
  }
  void study(const std::string& lines) {
    folder_.write("s.yaml", "gaitlab_study: 1\nscenario: two.yaml\nguards: none\n" + lines);
  }
  Result call(const std::string& arguments) { return gaitlab(arguments, folder_.path()); }
  studies::Journal journal(const std::string& out) { return studies::Journal(folder_ / (out + "/study.db")); }

  Folder folder_;
};

constexpr const char* kGentle =
    "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nobjective: {minimize: torque.peak}\nverify: {best: 1, change: 0.5, "
    "engine: bullet}\n";

TEST_F(Optimize, ABestThatStandsHasItsFolder) {
  study(kGentle + std::string("budget: {runs: 24}\n"));
  ASSERT_EQ(call("optimize s.yaml --out o --quiet").code, 0);
  studies::Journal journal = this->journal("o");
  const std::vector<studies::Verification> tried = journal.verifications();
  ASSERT_EQ(tried.size(), 20U);
  EXPECT_EQ(tried[0].what(), "as run");
  EXPECT_EQ(tried[1].what(), "half step");
  EXPECT_EQ(tried[2].what(), "bullet");
  EXPECT_EQ(tried[3].what(), "world friction -25 % (0.6)");
  EXPECT_TRUE(tried[19].kind == studies::TrialKind::worlds);
  for (const studies::Verification& v : tried) EXPECT_EQ(v.reason, "");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "o/best/report.html"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "o/convergence.svg"));
  const std::vector<studies::Generation> generations = journal.generations();
  ASSERT_FALSE(generations.empty());
  EXPECT_EQ(generations[0].points, 16U);
  // Repeating the command simulates nothing and gives the same result.
  EXPECT_EQ(call("optimize s.yaml --out o --quiet").code, 0);
  EXPECT_EQ(this->journal("o").effort().runs, 24U);
  // The last generation is also written, although the budget cuts it off.
  EXPECT_NE(read(folder_ / "o/convergence.csv").find("\n0,1,0,8,"), std::string::npos) << read(folder_ / "o/convergence.csv");
  // With a smaller budget, all existing runs still count.
  const Result fewer = call("optimize s.yaml --out o --runs 20");
  EXPECT_EQ(fewer.code, 0);
  EXPECT_TRUE(contains(fewer.err, "o: note: has runs up to number 23, beyond the budget of 20; all of them count\n"))
      << fewer.err;
  EXPECT_TRUE(contains(fewer.err,
                       "s.yaml:4:14: note: the search does not begin with the scenario's own gait: cpg.amplitude is 0.6 in the "
                       "scenario, outside the parameter's range\n"))
      << fewer.err;
  EXPECT_NE(fewer.out.find("24 of 24 runs ended"), std::string::npos) << fewer.out;
}

TEST_F(Optimize, TriesTheWinnerWithEachJointDead) {
  study(
      "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nobjective: {minimize: torque.peak}\nverify: {best: 1, change: 0.5, "
      "worlds: false, faults: each}\nbudget: {runs: 16}\n");
  const Result result = call("optimize s.yaml --out o");
  ASSERT_EQ(result.code, 0) << result.err;
  studies::Journal journal = this->journal("o");
  std::vector<studies::Verification> tried = journal.verifications();
  ASSERT_EQ(tried.size(), 6U);
  EXPECT_EQ(studies::verified(tried), std::vector<std::uint64_t>{tried[0].run});
  const std::string dead = result.out.substr(result.out.find(fmt::format("run {} with a joint dead", tried[0].run)));
  std::vector<std::string> verdicts;
  for (std::size_t k = 2; k < 6; ++k) {
    EXPECT_TRUE(tried[k].kind == studies::TrialKind::dead_joint) << tried[k].what();
    EXPECT_EQ(tried[k].reason, "");
    EXPECT_NE(dead.find(tried[k].what()), std::string::npos) << dead;
  }
  EXPECT_EQ(tried[2].what(), "m0/active dead");
  EXPECT_EQ(call("study show o").out.find("with a joint dead from t = 0:\n") == std::string::npos, false);
  // A dead joint changes the objective.
  const std::vector<std::string> row = journal.row(tried[0].run);
  EXPECT_NE(tried[2].objectives[0], tried[0].objectives[0]);
}

TEST_F(Optimize, FaultsNeedAScenarioWithoutChanges) {
  study(
      "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nobjective: {minimize: torque.peak}\nset: ['at=[{t: 1, set: "
      "{cpg.frequency: 1}}]']\nverify: {faults: each}\nbudget: {runs: 16}\n");
  const Result result = call("optimize s.yaml --dry-run");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("`verify.faults: each` needs a scenario without a section `at`, but this one has one; expected "
                            "another scenario, or `faults: none`"),
            std::string::npos)
      << result.err;
}

TEST_F(Optimize, TellsWhatItWouldDo) {
  study(kGentle + std::string("budget: {runs: 24}\n"));
  const Result result = call("optimize s.yaml --dry-run -j 1");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(
      result.out.rfind("24 runs: 24 points, 1 run each\nmethod scbo chooses the points, and the best 1 are simulated again\n"
                       "72 s simulated in all\ntakes ",  // "less than 0.1 s" on a fast machine
                       0),
      0U)
      << result.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs"));
}

TEST_F(Optimize, TakesAnswersOfOtherStudies) {
  study(kGentle + std::string("budget: {runs: 24}\n"));
  ASSERT_EQ(call("optimize s.yaml --out o --quiet").code, 0);
  study(kGentle + std::string("budget: {runs: 32}\nconstraints: [speed <= 1000]\n"));
  ASSERT_EQ(call("optimize s.yaml --out more --answers o --quiet").code, 0);
  ASSERT_EQ(call("optimize s.yaml --out own --quiet").code, 0);
  EXPECT_EQ(read(folder_ / "more/table.csv"), read(folder_ / "own/table.csv"));
}

TEST_F(Optimize, FiguresMarkTheBestThatStood) {
  const std::string wide =
      "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nobjective: {minimize: torque.peak}\n"
      "budget: {runs: 16}\nverify: {best: 1, change: ";
  study(wide + "9}\n");
  ASSERT_EQ(call("optimize s.yaml --out stood --quiet").code, 0);
  study(wide + "1e-6}\n");
  ASSERT_EQ(call("optimize s.yaml --out fell --quiet").code, 3);
  const auto marked = [&](const char* out) {
    return read(folder_ / (out + std::string("/speed.csv"))).find(",1\n") != std::string::npos;
  };
  EXPECT_TRUE(marked("stood"));
  EXPECT_FALSE(marked("fell"));
}

TEST_F(Optimize, WhatChangesWithTheStepIsNotVerified) {
  study(kGentle + std::string("budget: {runs: 16}\n"));
  std::string text = read(folder_ / "s.yaml");
  text.replace(text.find("change: 0.5"), 11, "change: 1e-6");
  folder_.write("s.yaml", text);
  const Result result = call("optimize s.yaml --out o");
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("o: none of the best points was verified"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("half step: torque.peak is "), std::string::npos) << result.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "o/best"));
}

/// Two modules of 0.8 kg that must not be heavier. They fall in the worlds with more mass and in some of the draws.
TEST_F(Optimize, AShareOfTheWorldsDecides) {
  const std::string heavy =
      "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nobjective: {minimize: torque.peak}\nbudget: {runs: 16}\n"
      "constraints: [mass <= 0.8001]\nverify: {best: 1, change: 9, share: ";
  study(heavy + "1}\n");
  const Result fell = call("optimize s.yaml --out fell -j 2");
  EXPECT_EQ(fell.code, 3);
  const std::vector<studies::Verification> tried = journal("fell").verifications();
  ASSERT_FALSE(tried.empty());
  const studies::WorldCount count = studies::counted_worlds(tried, tried.front().run);
  ASSERT_EQ(count.falls.size(), 1U);
  EXPECT_EQ(count.falls.front().what(), "world mass +3 % (0.824 kg)");
  EXPECT_EQ(count.stood, 15 - count.fell_drawn);
  const std::string nearest = fmt::format(
      "fell: none of the best points was verified; run {} is nearest: it stands in {} of 16 worlds; 16 are needed; falls by "
      "mass +3 % (0.824 kg): mass <= 0.8001 (0.824); and in {} of 7 draws; to search gaits with a reserve, take `robust: "
      "true`\n",
      tried.front().run, count.stood, count.fell_drawn);
  EXPECT_TRUE(fell.err.ends_with(nearest)) << fell.err << nearest;
  EXPECT_NE(fell.err.find("verification of the best point: 1 run\npoints that stand, in worlds: 16 runs\nverification of the "
                          "next best point: 1 run\n"),
            std::string::npos)
      << fell.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fell/best"));
  study(heavy + "0.5}\n");
  const Result stood = call("optimize s.yaml --out stood -j 1");
  EXPECT_EQ(stood.code, 0) << stood.err;
  const std::string line = fmt::format("run {} verified, stands in {} of 16 worlds (", tried.front().run, count.stood);
  EXPECT_NE(stood.out.find(line), std::string::npos) << stood.out;
  EXPECT_NE(call("study show stood").out.find(line), std::string::npos);
  const std::vector<studies::Verification> other = journal("stood").verifications();
  ASSERT_EQ(4 * other.size(), tried.size()) << "four rounds where none stands";
  for (std::size_t k = 0; k + 1 < other.size(); ++k) {
    EXPECT_EQ(other[k].what(), tried[k].what());
    EXPECT_EQ(other[k].objectives, tried[k].objectives) << "with another number of threads";
  }
}

/// The worlds of a robust study are its replicates, in sweeps and searches, for any number of threads, in shards and again.
TEST_F(Optimize, ARobustStudyRunsEveryPointInItsWorlds) {
  study(
      "parameters: {cpg.amplitude: {low: 0.05, high: 0.2, count: 2}}\nrobust: true\nset: [duration=0.6]\nestimate_every: 1\n");
  ASSERT_EQ(call("sweep s.yaml --out one --quiet -j 1 --lanes 1").code, 0);
  ASSERT_EQ(call("sweep s.yaml --out two --quiet -j 2").code, 0);
  const std::string table = read(folder_ / "one/table.csv");
  EXPECT_TRUE(table == read(folder_ / "two/table.csv"));
  EXPECT_EQ(journal("one").rows(), 34U);
  for (const char* shard : {"0/2", "1/2"})
    ASSERT_EQ(call(std::string("sweep s.yaml --out parts --quiet --shard ") + shard).code, 0);
  ASSERT_EQ(call("study merge parts").code, 0);
  EXPECT_TRUE(table == read(folder_ / "parts/table.csv"));
  for (const char* run : {"0", "8", "33"}) {
    const Result again = call(std::string("study rerun one ") + run);
    EXPECT_NE(again.out.find("the quantities are equal to those in the journal"), std::string::npos) << run << again.err;
  }
}

TEST_F(Optimize, WhatNobodyCouldJudgeIsNotVerified) {
  study("set: [duration=0.3]\n" + std::string(kGentle) + "budget: {runs: 16}\n");
  const Result result = call("optimize s.yaml --out o");
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.out.find("not verified (as run "), std::string::npos) << result.out;
  for (const studies::Verification& v : journal("o").verifications())
    EXPECT_EQ(v.reason.rfind("not judged: ", 0), 0U) << v.what() << ": " << v.reason;
  EXPECT_NE(result.out.find(
                "half step: not judged: 0.3 s contain only 0.3 of the 3 periods of 1 s that a gait needs; take duration: 3;"),
            std::string::npos)
      << result.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "o/best"));
}

TEST_F(Optimize, NothingFeasibleIsToldSo) {
  study("parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nconstraints: [speed >= 1000]\nbudget: {runs: 20}\n");
  const Result result = call("optimize s.yaml --out o --quiet");
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(result.err, "o: no point is kept; `gaitlab study show o` says which limits most runs break\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "o/table.csv"));
}

TEST_F(Optimize, WordsHaveASearchEach) {
  study(
      "parameters: {cpg.type: {values: [phase_oscillator, hopf]}, cpg.amplitude: {low: 0.05, high: 0.2}}\n"
      "objective: {minimize: torque.peak}\nverify: {change: 9}\nmethod: {type: sade, population: 8}\nbudget: {runs: 36}\n");
  ASSERT_EQ(call("optimize s.yaml --out o --quiet").code, 0);
  const std::string table = read(folder_ / "o/table.csv");
  EXPECT_NE(table.find(",phase_oscillator,"), std::string::npos);
  EXPECT_NE(table.find(",hopf,"), std::string::npos);
  const std::vector<studies::Generation> generations = journal("o").generations();
  ASSERT_GE(generations.size(), 2U);
  EXPECT_EQ(generations.front().search, 0U);
  EXPECT_EQ(generations.back().search, 1U);
}

TEST_F(Optimize, RunsThatAreRefusedAreResults) {
  // The step is unstable on this stiff ground.
  study(
      "set: [contact.stiffness=1e10, physics.integrator=rk4, physics.step=0.005]\n"
      "parameters: {cpg.amplitude: {low: 0.05, high: 1}}\nbudget: {runs: 20}\n");
  const Result result = call("optimize s.yaml --out o --quiet");
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(
      result.err.rfind("o: the search has ended, because the scenario refused all 16 points of the first block: step 0.005 s "
                       "is too long",
                       0),
      0U)
      << result.err;
}

TEST_F(Optimize, CommandsAreToldApart) {
  study(kGentle + std::string("method: {type: cma}\nbudget: {runs: 24}\n"));
  const Result sweep = call("sweep s.yaml");
  EXPECT_EQ(sweep.code, 2);
  EXPECT_EQ(sweep.err, "s.yaml: error: its method cma searches; use gaitlab optimize s.yaml\n");
  const Result scenario = call("optimize two.yaml");
  EXPECT_EQ(scenario.code, 2);
  EXPECT_EQ(scenario.err, "two.yaml:1:1: error: this is a scenario, not a study; run it with gaitlab run two.yaml\n");
  for (const char* command : {"run", "check", "swap --cpg hopf"}) {
    const Result run = call(command + std::string(" s.yaml"));
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(run.err, "s.yaml:1:1: error: this is a study, not a scenario; run it with gaitlab sweep or gaitlab optimize\n");
  }
  const Result few = call("optimize s.yaml --runs 9");
  EXPECT_EQ(few.code, 2);
  EXPECT_EQ(few.err, "--runs: error: a budget of 9 runs is too small: the first generation of all searches has 16 runs\n");
  ASSERT_EQ(call("optimize s.yaml --method random --out r --quiet").code, 0);  // random points instead of a search
  EXPECT_TRUE(journal("r").generations().empty());
  EXPECT_EQ(call("optimize s.yaml --out r --quiet").code, 2);  // the folder contains a different study
}

}  // namespace
}  // namespace gaitlab::test
