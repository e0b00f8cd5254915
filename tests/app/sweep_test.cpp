// Tests of `gaitlab sweep` and `gaitlab study`: rows equal runs, unsuitable folders are refused, failed runs are results.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/files/atomic_file.h"
#include "studies/journal/journal.h"
#include "tests/app/study_fixture.h"
#include "tests/folders.h"

namespace gaitlab::test {
namespace {

class Sweep : public StudyFixture {};

/// A point that only fails the check of a continuous rating (`heat`) is not kept.
TEST_F(Sweep, WhatTheVerdictFailsIsNotFeasible) {
  ASSERT_EQ(
      call("sweep two.yaml --set duration=6 --set cpg.amplitude=0.3 --grid actuator.i_continuous=1e-6,1e3 --out s --quiet")
          .code,
      0);
  const auto rows = table("s");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("verdict"), "infeasible");
  EXPECT_EQ(rows[0].at("feasible"), "0");
  EXPECT_LT(std::stod(rows[0].at("margin.heat")), -1);
  const double beyond = -std::stod(rows[0].at("margin.heat"));
  EXPECT_NEAR(std::stod(rows[0].at("violation")), beyond / (1 + beyond), 1e-12) << "no other guard is broken";
  EXPECT_EQ(rows[0].at("margin"), rows[0].at("margin.heat"));
  EXPECT_TRUE(contains(rows[0].at("message"), "A RMS, ")) << rows[0].at("message");
  EXPECT_EQ(rows[1].at("verdict"), "feasible");
  EXPECT_EQ(rows[1].at("violation"), "0");
  EXPECT_EQ(rows[1].at("message"), "");
  EXPECT_EQ(rows[1].at("feasible"), "1");
  EXPECT_EQ(rows[1].at("kept"), "1");
}

/// A study without guards keeps infeasible points and does not call them feasible.
TEST_F(Sweep, WithoutGuardsInfeasibleGaitsAreKeptAndNotFeasible) {
  folder_.write("study.yaml", "gaitlab_study: 1\nscenario: " + kScenarios +
                                  "caterpillar.yaml\nset: [physics.engine=articulated, duration=6]\nguards: none\n"
                                  "parameters: {cpg.amplitude: {values: [1.7]}}\n");
  const Result swept = call("sweep study.yaml --out s");
  ASSERT_EQ(swept.code, 0) << swept.err;
  EXPECT_TRUE(contains(swept.out, "study: 1 of 1 runs ended, 1 kept (100 %), 0 feasible, 0 failed\n")) << swept.out;
  const Result shown = call("study show s");
  EXPECT_TRUE(contains(shown.out, "study: 1 of 1 runs ended, 1 kept (100 %), 0 feasible, 0 failed\n")) << shown.out;
  const auto rows = table("s");
  EXPECT_EQ(rows[0].at("verdict"), "infeasible");
  EXPECT_EQ(rows[0].at("kept"), "1");
  EXPECT_EQ(rows[0].at("feasible"), "0");
}

/// The output states the check and the part for which a point is not kept.
TEST_F(Sweep, SaysWhyAPointIsNotKept) {
  const Result swept =
      call("sweep two.yaml --set duration=6 --set cpg.amplitude=0.3 --grid actuator.i_continuous=1e-6 --out s");
  ASSERT_EQ(swept.code, 0) << swept.err;
  EXPECT_TRUE(contains(swept.out, "two: 1 of 1 runs ended, 0 kept (0 %), 0 feasible, 0 failed\n")) << swept.out;
  EXPECT_TRUE(contains(swept.out, "run 0 is not kept: the motor of joint m")) << swept.out;
  EXPECT_TRUE(contains(swept.out, "broken limits, most frequent first: the verdict (1 run), check heat (1 run)\n"))
      << swept.out;
  const Result best = call("study best s");
  EXPECT_EQ(best.code, 3);
  EXPECT_EQ(best.err, "s: no point is kept\n");
}

/// If runs are too short for a verdict on a slow gait, a note states this before the first run.
TEST_F(Sweep, NotesRunsThatAreTooShortForAVerdict) {
  const Result swept = call("sweep two.yaml --set duration=3 --random cpg.frequency=0.25:1 --runs 1 --out s");
  EXPECT_EQ(swept.code, 0);
  EXPECT_EQ(swept.err,
            "--random cpg.frequency=0.25:1: note: a gait of 0.25 Hz has 0.75 periods in 3 s; without a limit cycle a "
            "verdict needs 3: take duration=12, or `low: 1`\n");
}

TEST_F(Sweep, ItsFilesAreMadeAnew) {
  ASSERT_EQ(call("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:3 --out s --quiet").code, 0);
  const std::string figure = read(folder_ / "s/speed.svg");
  const std::string rows = read(folder_ / "s/table.csv");
  std::filesystem::remove(folder_ / "s/speed.svg");
  folder_.write("s/table.csv", "cut");
  const Result again = call("study report s");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out, "files in s: table.csv, speed.svg\n");
  EXPECT_EQ(read(folder_ / "s/speed.svg"), figure);
  EXPECT_EQ(read(folder_ / "s/table.csv"), rows);
}

TEST_F(Sweep, ItsRowsAreRuns) {
  ASSERT_EQ(call("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:3 --out s -j 2 --quiet").code, 0);
  const auto rows = table("s");
  ASSERT_EQ(rows.size(), 3U);
  for (const auto& row : rows) {
    const std::string lag = row.at("cpg.phase_lag");
    ASSERT_EQ(call(fmt::format("run two.yaml --no-report --set cpg.phase_lag={0} --out r{0}", lag)).code, 0);
    const auto summary = nlohmann::json::parse(read(folder_ / ("r" + lag + "/summary.json")));
    const auto verdict = nlohmann::json::parse(read(folder_ / ("r" + lag + "/verdict.json")));
    EXPECT_EQ(std::stod(row.at("speed")), summary.at("speed").get<double>());
    EXPECT_EQ(std::stod(row.at("energy.electrical")), summary.at("energy").at("electrical").get<double>());
    EXPECT_EQ(std::stod(row.at("limit_cycle.error")), summary.at("limit_cycle").at("error").get<double>());
    EXPECT_EQ(row.at("verdict"), verdict.at("verdict").get<std::string>());
    double peak = 0;
    for (const auto& [joint, of] : summary.at("per_joint").items())
      peak = std::max(peak, of.at("torque").at("peak").get<double>());
    EXPECT_EQ(std::stod(row.at("torque.peak")), peak);
    const Result again = call("study rerun s " + row.at("run"));
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_TRUE(contains(again.out, "the quantities are equal to those in the journal")) << again.out;
  }
  EXPECT_TRUE(contains(read(folder_ / "s/speed.svg"), "cpg.phase_lag"));
  EXPECT_EQ(read(folder_ / "s/speed.csv").substr(0, 45), "cpg.phase_lag,speed,least,largest,state,best\n");
}

TEST_F(Sweep, TheSameCommandGoesOnInItsFolder) {
  const std::string command = "sweep two.yaml --grid cpg.phase_lag=0.5:1.5:2 --quiet";
  ASSERT_EQ(call(command).code, 0);
  const std::string first = read(folder_ / "runs/sweep-two/table.csv");
  ASSERT_EQ(call(command).code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs/sweep-two-2"));
  EXPECT_EQ(read(folder_ / "runs/sweep-two/table.csv"), first);
  ASSERT_EQ(call("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:3 --quiet").code, 0);  // a different study has its own folder
  EXPECT_TRUE(std::filesystem::exists(folder_ / "runs/sweep-two-2/study.db"));
  refused("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:3 --out runs/sweep-two",
          "runs/sweep-two/study.db: error: belongs to another study; choose another folder (--out), or continue it as it was "
          "begun: gaitlab "
          "sweep "
          "two.yaml --grid cpg.phase_lag=0.5:1.5:2 --out runs/sweep-two\n"
          "  study, line 3: \"parameter cpg.phase_lag: 0.5 to 1.5, 3 values\", was \"parameter cpg.phase_lag: 0.5 to 1.5, 2 "
          "values\"");
  EXPECT_EQ(read(folder_ / "runs/sweep-two/table.csv"), first);
}

/// A value that no run can have is an error before the first run.
TEST_F(Sweep, RefusesAValueThatCannotRun) {
  refused("sweep two.yaml --grid cpg.type=hopf,phase_osillator --out s",
          "--grid cpg.type=hopf,phase_osillator: error: type 'phase_osillator' is unknown; did you mean 'phase_oscillator'?");
  refused("sweep two.yaml --set physics.integrator=implicit --grid physics.step=0.001,0.0007 --out s",
          "--grid physics.step=0.001,0.0007: error: trace period 0.015 s is not a whole multiple of the step 0.0007 s "
          "(21.4285714286 steps); steps that fit: 0.000625, 0.00075; periods that fit: 0.0147, 0.0154");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "s"));
}

TEST_F(Sweep, WhatFailsIsAResult) {
  // The causes of failure are a trace period that is not a multiple of the step, and a motor that diverges.
  ASSERT_EQ(call("sweep two.yaml --set physics.integrator=implicit --grid physics.step=0.001,0.0015 --grid "
                 "trace.period=0.015,0.02 --out s --quiet")
                .code,
            0);
  auto rows = table("s");
  ASSERT_EQ(rows.size(), 4U);
  for (const std::size_t k : {0U, 1U, 2U}) EXPECT_EQ(rows[k].at("outcome"), "done");
  EXPECT_EQ(rows[3].at("outcome"), "refused");
  EXPECT_TRUE(contains(rows[3].at("message"), "not a whole multiple of the step")) << rows[3].at("message");
  EXPECT_EQ(rows[3].at("speed"), "");
  EXPECT_EQ(rows[3].at("kept"), "0");
  const Result diverged =
      call("sweep two.yaml --grid controller.Kp=1e8 --set actuator.type=torque --set 'controller.unit=N m' --out d");
  EXPECT_EQ(diverged.code, 1) << diverged.out;
  EXPECT_TRUE(contains(diverged.err, "none of the 1 runs came to its end")) << diverged.err;
  EXPECT_EQ(table("d")[0].at("outcome"), "diverged");
  EXPECT_TRUE(contains(diverged.out, "1 diverged, first: run 0: diverged at step")) << diverged.out;
}

/// A run whose plugin throws is a failed result. A run whose plugin ends the process is a failed result after two attempts.
TEST_F(Sweep, SurvivesPlugins) {
  folder_.write("plugin.yaml", "gaitlab: 1\nplugins: [" + std::string(gaitlab::test::build_folder()) +
                                   "/plugins/throws.so]\nrobot: {modules: mtran, base: fixed}\nground: {type: none}\n"
                                   "contact: {on: none}\nphysics: {engine: articulated}\nduration: 0.3\n"
                                   "cpg: {type: throws, where: nowhere}\n");
  const std::string command = "sweep plugin.yaml --grid cpg.where=nowhere,output,abort --out s --quiet -j 1";
  EXPECT_GT(call(command).code, 2);  // the process ends by a signal
  EXPECT_GT(call(command).code, 2);
  const Result third = call(command);
  EXPECT_EQ(third.code, 0) << third.err;
  const auto rows = table("s");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("outcome"), "done");
  EXPECT_EQ(rows[1].at("outcome"), "plugin");
  EXPECT_TRUE(contains(rows[1].at("message"), "no luck")) << rows[1].at("message");
  EXPECT_EQ(rows[2].at("outcome"), "crashed");
  EXPECT_EQ(rows[2].at("message"), "the process ended by signal 6");
}

TEST_F(Sweep, RefusesWhatCannotBeRun) {
  refused("sweep two.yaml",
          "gaitlab sweep: error: nothing changes from run to run; expected --grid KEY=A:B:N, --random KEY=A:B or --seeds N");
  refused("sweep two.yaml --grid cpg.phase_lga=1:2:3",
          "--grid cpg.phase_lga=1:2:3: error: unknown key 'phase_lga'; did you mean 'phase_lag'?");
  refused("sweep two.yaml --grid cpg.phase_lag=1:2",
          "--grid cpg.phase_lag=1:2: error: expected KEY=LOW:HIGH:N, KEY=log:LOW:HIGH:N or KEY=v,v,v");
  refused("sweep two.yaml --grid cpg.phase_lag=2:1:3",
          "--grid cpg.phase_lag=2:1:3: error: cpg.phase_lag: low is 2, not below high, 1");
  refused("sweep two.yaml --random cpg.phase_lag=1:2", "--runs: error: is missing; --random needs a number of runs");
  refused("sweep two.yaml --grid cpg.phase_lag=1:2:3 --show spede",
          "--show: error: no quantity is named 'spede'; did you mean 'speed'?");
  refused("sweep two.yaml --grid cpg.phase_lag=1:2:3 --shard 3/3 --out s",
          "--shard: error: is '3/3'; expected I/N with I from 0 to N - 1, or auto");
  refused("study show nowhere", "nowhere: error: holds no study: there is no study.db");
  folder_.write("study.yaml", "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.phase_lag: {values: [1]}}\n");
  refused("sweep study.yaml --grid cpg.phase_lag=1:2:3",
          "--grid: error: cannot be combined with a study file; write parameters in that file");
}

TEST_F(Sweep, FoldersOfStrangersAreData) {
  ASSERT_EQ(call("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:2 --out s --quiet").code, 0);
  std::filesystem::create_directories(folder_ / "foreign");
  folder_.write("foreign/study.db", "this is not a database, but a text of more than sixteen bytes");
  refused("study show foreign", "foreign/study.db: error: is not a database of SQLite");
  refused("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:2 --out foreign --quiet",
          "foreign/study.db: error: is not a database of SQLite");
  {
    studies::Database other(folder_ / "foreign2.db", studies::Database::Mode::write);
    other.execute("CREATE TABLE t(x)");
  }
  std::filesystem::create_directories(folder_ / "other");
  std::filesystem::rename(folder_ / "foreign2.db", folder_ / "other/study.db");
  refused("study best other", "other/study.db: error: is a database of SQLite, and not the journal of a study");
  // A view instead of a table is refused, because it would execute SQL of its author.
  std::filesystem::copy(folder_ / "s", folder_ / "view");
  {
    studies::Database changed(folder_ / "view/study.db", studies::Database::Mode::write);
    changed.execute("ALTER TABLE effort RENAME TO e; CREATE VIEW effort AS SELECT * FROM e");
  }
  refused("study show view", "view/study.db: error: is not a journal that this program wrote: its table effort is another");
  // A truncated database is refused.
  std::filesystem::copy(folder_ / "s", folder_ / "cut");
  std::filesystem::resize_file(folder_ / "cut/study.db", std::filesystem::file_size(folder_ / "cut/study.db") / 2);
  const Result cut = call("study show cut");
  EXPECT_EQ(cut.code, 2);
  EXPECT_TRUE(contains(cut.err, "cut/study.db: error: is damaged: ")) << cut.err;
  // A folder with other files is refused.
  std::filesystem::create_directories(folder_ / "full");
  folder_.write("full/thesis.tex", "x");
  refused("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:2 --out full", "--out full: error: exists and is not empty");
}

/// Stop rules end runs at times that do not depend on the lanes. The largest speed at amplitude A and 1 Hz is 2 pi A: 0.6
/// and 1.9 rad/s for the first two points, 3.8 and 5 rad/s for the others.
TEST_F(Sweep, RulesEndRunsAtTheSameTimeWhateverTheLanes) {
  const std::string study =
      "gaitlab_study: 1\nscenario: two.yaml\nset: [duration=3.5]\nguards: none\n"
      "parameters: {cpg.amplitude: {values: [0.1, 0.3, 0.6, 0.8]}}\n";
  folder_.write("all.yaml", study);
  folder_.write("stops.yaml", study + "stop: [distance > 100, \"speed.peak > 2.9 after 2\"]\n");
  ASSERT_EQ(call("sweep all.yaml --out all --quiet").code, 0);
  ASSERT_EQ(call("sweep stops.yaml --out one --lanes 1 --quiet").code, 0);
  const Result eight = call("sweep stops.yaml --out eight --lanes 8 -j 1");
  ASSERT_EQ(eight.code, 0) << eight.err;
  EXPECT_EQ(read(folder_ / "one/table.csv"), read(folder_ / "eight/table.csv"));
  EXPECT_TRUE(contains(eight.out, "2 stopped, first: run 2: stopped by speed.peak > 2.9 after 2 at t = 2 s")) << eight.out;
  const auto whole = table("all");
  const auto rows = table("one");
  ASSERT_EQ(rows.size(), 4U);
  for (const std::size_t k : {0U, 1U}) EXPECT_EQ(rows[k], whole[k]) << k;  // a rule without effect changes no bit
  for (const std::size_t k : {2U, 3U}) {
    EXPECT_EQ(rows[k].at("outcome"), "stopped");
    EXPECT_EQ(rows[k].at("simulated"), "2");
    EXPECT_NE(rows[k].at("speed"), "") << "of what ran";
    EXPECT_EQ(rows[k].at("violation"), "") << "without guards it breaks no limit, and must not be kept";
    EXPECT_EQ(rows[k].at("kept"), "0");
  }
  const Result again = call("study rerun one 2");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(contains(again.out, "the study ended this run early")) << again.out;
}

TEST_F(Sweep, TakesAnswersOfOtherStudies) {
  const auto sweep = [&](const std::string& arguments) {
    const Result result = call("sweep two.yaml " + arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.out;
  };
  sweep("--grid cpg.phase_lag=0.4:2:9 --out nine --quiet");
  sweep("--grid cpg.phase_lag=0.4:2:17 --out plain --quiet");
  const std::string out = sweep("--grid cpg.phase_lag=0.4:2:17 --out answered --answers nine/study.db");
  EXPECT_TRUE(contains(out, "9 of 17 runs were taken from other studies")) << out;
  EXPECT_EQ(read(folder_ / "answered/table.csv"), read(folder_ / "plain/table.csv"));
  // With a different objective the scores are computed again.
  folder_.write("cost.yaml",
                "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.phase_lag: {low: 0.4, high: 2, count: 9}}\n"
                "objective: {minimize: torque.rms}\nconstraints: [speed >= 0.001]\n");
  const Result other = call("sweep cost.yaml --out cost --answers nine");
  EXPECT_TRUE(contains(other.out, "9 of 9 runs were taken from other studies")) << other.out << other.err;
  for (const auto& row : table("cost")) EXPECT_EQ(row.at("objective.1"), row.at("torque.rms"));
  // Rows of a different duration are not used, and replicates have other seeds.
  EXPECT_TRUE(contains(sweep("--grid cpg.phase_lag=0.4:2:9 --set duration=0.31 --out longer --answers nine"), "0 of 9 runs"));
  EXPECT_TRUE(contains(sweep("--grid cpg.phase_lag=0.4:2:9 --seeds 1 --out seeds --answers nine"), "0 of 9 runs"));
  refused("sweep two.yaml --grid cpg.phase_lag=0.4:2:9 --out x --answers nowhere.db",
          "nowhere.db: error: does not exist; expected the study.db of a study");
}

/// Points with equal values are simulated once, and all have the results.
TEST_F(Sweep, RunsEqualPointsOnce) {
  ASSERT_EQ(call("sweep two.yaml --random cpg.amplitude=0.2,0.3 --runs 12 --out s --quiet").code, 0);
  const auto rows = table("s");
  ASSERT_EQ(rows.size(), 12U);
  std::map<std::string, std::string> speeds;
  for (const auto& row : rows) {
    const auto [at, first] = speeds.emplace(row.at("point"), row.at("speed"));
    EXPECT_EQ(at->second, row.at("speed"));
  }
  EXPECT_EQ(speeds.size(), 2U);
  ASSERT_EQ(call("sweep two.yaml --random cpg.amplitude=0.2,0.3 --runs 12 --out t --quiet -j 1 --lanes 1").code, 0);
  EXPECT_EQ(read(folder_ / "s/table.csv"), read(folder_ / "t/table.csv"));
}

TEST_F(Sweep, OfMoreThanTwoParametersIsDrawn) {
  const Result result = call(
      "sweep two.yaml --grid cpg.amplitude=0.2,0.3 --grid cpg.phase_lag=1:2:3 --grid cpg.type=phase_oscillator,hopf "
      "--seeds 2 --out s");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "speed.svg, speed-scatter.svg, replicates.svg")) << result.out;
  const std::string csv = read(folder_ / "s/speed.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "cpg.amplitude,cpg.phase_lag,cpg.type,speed,state,best");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 13);
  EXPECT_TRUE(contains(csv, "0.2,1,hopf,"));
  EXPECT_TRUE(contains(read(folder_ / "s/speed.svg"), ">cpg.phase_lag (rad)<"));
}

TEST_F(Sweep, OfSensitivityEndsWithATable) {
  const std::string study =
      "gaitlab_study: 1\nscenario: two.yaml\n"
      "parameters: {cpg.amplitude: {low: 0.1, high: 0.4}, actuator.R: {low: 4, high: 5}}\n";
  folder_.write("morris.yaml", study + "method: {type: morris, trajectories: 4}\n");
  folder_.write("sobol.yaml", study + "method: {type: sobol_indices, samples: 4}\n");
  const Result morris = call("sweep morris.yaml --out m");
  ASSERT_EQ(morris.code, 0) << morris.err;
  EXPECT_EQ(table("m").size(), 12U);
  EXPECT_TRUE(contains(morris.out, "influence on speed, m/s per range of the parameter: 4 of 4 trajectories")) << morris.out;
  EXPECT_TRUE(contains(call("study show m").out, "mu_star")) << morris.out;
  const Result sobol = call("sweep sobol.yaml --out s");
  ASSERT_EQ(sobol.code, 0) << sobol.err;
  EXPECT_EQ(table("s").size(), 16U);
  EXPECT_TRUE(
      contains(read(folder_ / "s/sensitivity.csv"), "output,parameter,measure,value,low,high\nspeed,cpg.amplitude,total,"));
  const std::string bars = read(folder_ / "s/sensitivity-speed.svg");
  EXPECT_TRUE(contains(bars, "share of the variance"));
  // Shares are 0 <= first <= total <= 1 by definition. Figure and table report estimates that contradict this.
  std::map<std::string, double> value;
  static const std::regex kRow("speed,([a-zA-Z.]+),(total|first),([^,]*),");
  const std::string csv = read(folder_ / "s/sensitivity.csv");
  for (std::sregex_iterator it(csv.begin(), csv.end(), kRow), end; it != end; ++it)
    value[std::string((*it)[1]) + std::string((*it)[2])] = std::stod((*it)[3]);
  ASSERT_EQ(value.size(), 4U);
  std::size_t few = 0;
  for (const std::string key : {"cpg.amplitude", "actuator.R"}) {
    const double first = value[key + "first"];
    const double total = value[key + "total"];
    few += first < -0.01 || first > total + 0.01 || total > 1.01 ? 1U : 0U;
  }
  EXPECT_GT(few, 0U);  // with 4 samples; choose another number if this ever fails
  std::size_t remarks = 0;
  for (std::size_t at = 0; (at = bars.find(">too few samples<", at)) != std::string::npos; ++at) ++remarks;
  EXPECT_EQ(remarks, few);
  EXPECT_TRUE(contains(call("study show s").out, "too few samples, the shares are impossible: "));
}

/// A sweep continues with a database without tables, which a kill or a full disk leaves during the creation of the journal.
TEST_F(Sweep, GoesOnWhereItsJournalWasNotMade) {
  std::filesystem::create_directory(folder_ / "s");
  folder_.write("s/study.db", "");
  const Result result = call("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:2 --quiet --out s");
  EXPECT_EQ(result.code, 0) << result.err;
}

TEST_F(Sweep, TellsWhatItWouldDo) {
  const Result dry = call("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:5 --seeds 2 --dry-run");
  EXPECT_EQ(dry.code, 0) << dry.err;
  EXPECT_TRUE(contains(dry.out, "10 runs: 5 points, 2 runs each\nfirst  cpg.phase_lag=0.5 seed=")) << dry.out;
  EXPECT_TRUE(contains(dry.out, "3 s simulated in all\n")) << dry.out;
  const Result wide = call("sweep two.yaml --random cpg.amplitude=0.1:3.5 --runs 4 --dry-run");
  EXPECT_EQ(wide.code, 0);
  EXPECT_TRUE(contains(wide.err,
                       "--random cpg.amplitude=0.1:3.5: note: cpg.amplitude is refused at its high of 3.5, with the other keys "
                       "as in the file: "))
      << wide.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs"));
}

}  // namespace
}  // namespace gaitlab::test
