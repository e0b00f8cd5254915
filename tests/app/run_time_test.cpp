// Tests of the estimated CPU time of a run, and of the advice to take the faster engine.
#include "app/gait/run_time.h"

#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongRunTime("FasterEngine.OtherCommandsNameItOnce:FasterEngine.RunAndSwapNameItBeforeTheRuns", "long");

using app::estimated_seconds;

/// Estimate of a run with these settings, s.
double estimate(const std::string& name, const std::vector<std::string>& sets, const RowsNeeded& rows = {}) {
  return estimated_seconds(shipped(name + ".yaml", sets), rows);
}

/// Estimate of a run of 0.1 s of a chain, s.
double estimate_of_chain(int modules, const std::string& engine, const std::string& mode = "full") {
  std::string docks;
  for (int k = 1; k < modules; ++k) docks += fmt::format("{}[1, {}, 4, {}, 0]", k == 1 ? "" : ", ", k, k - 1);
  return estimate("caterpillar", {"robot={modules: mtran, docks: [" + docks + "]}", "duration=0.1", "physics.engine=" + engine,
                                  "physics.estimate=" + mode});
}

/// The start of a robot is part of the estimate: it grows with the robot even where hardly a step is taken.
TEST(RunTimes, GrowWithTheRobotAtTheStart) {
  for (const std::string engine : {"bullet", "articulated"}) {
    double before = 0;
    for (const int modules : {2, 10, 50, 250}) {
      const double now = estimate_of_chain(modules, engine);
      EXPECT_GT(now, before) << engine << " " << modules;
      before = now;
    }
    EXPECT_GT(before, 0.5) << engine;
    EXPECT_GT(before, 3 * estimate_of_chain(50, engine)) << engine;
  }
}

TEST(RunTimes, IncludeTheTwins) {
  EXPECT_GT(estimate_of_chain(50, "articulated"), 1.1 * estimate_of_chain(50, "articulated", "off"));
  // The first window, 0.09 s with two steps for one of the run, is nearly all of this run.
  const auto explicit_run = [](const char* duration, const char* mode) {
    return estimate("caterpillar",
                    {"physics.step=2e-5", std::string("duration=") + duration, std::string("physics.estimate=") + mode});
  };
  EXPECT_GT(explicit_run("0.1", "full"), 1.5 * explicit_run("0.1", "off"));
  EXPECT_NEAR(explicit_run("20", "full") / explicit_run("20", "off"), 1.1, 0.03);  // the twin runs in one window of 20
}

/// Rows and set points of a long trace, and the judgement of a CPG, are part of the estimate.
TEST(RunTimes, IncludeRowsAndJudging) {
  EXPECT_GT(estimate("caterpillar", {"duration=1"}, {4000, 169}), 0.05 + estimate("caterpillar", {"duration=1"}));
  const Scenario one = shipped("caterpillar.yaml", {"duration=1"});
  EXPECT_GT(estimated_seconds(one), app::estimated_seconds_in_study(one));  // which writes and draws nothing
  Scenario none = one;
  none.cpg = {};
  EXPECT_GT(estimated_seconds(one), estimated_seconds(none));
}

TEST(RunTimes, TheTableHasEveryEngineAndIntegrator) {
  for (const std::string& engine : catalog().engines()) {
    for (const std::string& integrator : catalog().engine(engine)->integrator_names()) {
      const Scenario s = shipped("pendulum.yaml", {"physics.engine=" + engine, "physics.integrator=" + integrator,
                                                   integrator == "adaptive" ? "physics.step=auto" : "physics.step=1e-4"});
      EXPECT_GT(estimated_seconds(s), 0.03) << engine << " " << integrator;
    }
  }
  EXPECT_GT(estimated_seconds(shipped("hexapod.yaml", {"contact.law=bullet"})), 0.5);
}

TEST(RunTimes, GrowsWithDurationAndWithFinerSteps) {
  const auto of = [](const std::vector<std::string>& sets) { return estimated_seconds(shipped("caterpillar.yaml", sets)); };
  EXPECT_NEAR(of({"duration=40"}) - of({"duration=20"}), of({"duration=60"}) - of({"duration=40"}), 1e-9);
  EXPECT_GT(of({"physics.step=1e-5"}), 1.8 * of({"physics.step=2e-5"}));
  EXPECT_GT(of({"physics.engine=articulated", "physics.accuracy=0.001"}), 2 * of({"physics.engine=articulated"}));
  EXPECT_GT(of({}), 1.5 * of({"physics.engine=articulated"}));
  EXPECT_GT(of({"physics.integrator=semi_implicit"}), 3 * of({}));
}

TEST(RunTimes, TextsOfTimes) {
  EXPECT_EQ(app::about(0.03), "less than 0.1 s");
  EXPECT_EQ(app::about(0.56), "about 0.56 s");
  EXPECT_EQ(app::about(13.7), "about 14 s");
  EXPECT_EQ(app::about(150), "about 2.5 min");
  EXPECT_EQ(app::about(1e4), "about 2.8 h");
  EXPECT_EQ(app::about(1.8e8), "about 5.7 years");
}

class FasterEngine : public ::testing::Test {
 protected:
  static Result check(const std::string& arguments) { return gaitlab("check " + arguments, "."); }
  static std::string advised(const std::string& text) {
    const std::size_t at = text.find("engine articulated would take about ");
    if (at == std::string::npos) return "";
    const std::size_t open = text.find("(--set ", at), close = text.find(')', open);
    return text.substr(open + 1, close - open - 1);
  }
  const std::string hexapod = "'" + kScenarios + "hexapod.yaml' --set physics.integrator=semi_implicit";
  const std::string advice = "--set physics.engine=articulated --set physics.step=auto --set physics.integrator=adaptive";
};

TEST_F(FasterEngine, CheckNamesIt) {
  const Result first = check(hexapod);
  EXPECT_EQ(advised(first.out), advice) << first.out;
  EXPECT_EQ(first.out, check(hexapod).out);  // reads no clock
  // A command that follows the advice does not get it again.
  EXPECT_EQ(advised(check(hexapod + " " + advice).out), "");
}

TEST_F(FasterEngine, WithAStatedStep) {
  EXPECT_EQ(advised(check("'" + kScenarios + "hexapod.yaml' --set physics.step=2e-5").out),
            "--set physics.engine=articulated --set physics.step=auto");
}

TEST_F(FasterEngine, OnlyWhereItHelps) {
  EXPECT_EQ(advised(check(hexapod + " --set duration=2").out), "");  // the run takes less than 5 s
  EXPECT_EQ(advised(check(hexapod + " --set contact.law=bullet --set duration=200").out),
            "");  // only bullet has this contact law
  EXPECT_EQ(advised(check("'" + kScenarios + "library/y1-rolling.yaml' --set duration=200").out), "");  // has it
}

/// Every command prints the advice once, before its runs. --quiet omits it.
TEST_F(FasterEngine, OtherCommandsNameItOnce) {
  const Folder folder;
  const auto err = [&](const std::string& arguments) { return gaitlab(arguments, folder / "").err; };
  const std::string sweep = err("sweep " + hexapod + " --grid cpg.frequency=0.4:0.6:3 --dry-run --set duration=0.2 -j 1");
  EXPECT_EQ(advised(sweep), "");
  // 600 runs of 0.2 s; a dry run simulates only eight of them.
  const std::string many = err("sweep " + hexapod + " --grid cpg.frequency=0.4:0.6:600 --dry-run --set duration=0.2 -j 1");
  EXPECT_EQ(advised(many), advice) << many;
  EXPECT_EQ(many.find("engine articulated"), many.rfind("engine articulated")) << many;
  EXPECT_EQ(advised(err("sweep " + hexapod + " --grid cpg.frequency=0.4:0.6:600 --dry-run --set duration=0.2 --quiet")), "");
}

TEST_F(FasterEngine, RunAndSwapNameItBeforeTheRuns) {
  const Folder folder;
  // The commands are ended by a limit of CPU time; the note is printed before the first step.
  const auto err = [&](const std::string& arguments) {
    const std::string program = std::string("'") + gaitlab::test::build_folder() + "/bin/gaitlab' ";
    (void)std::system(
        fmt::format("cd '{}' && ( ulimit -t 1; {} {} >out 2>err )", folder.path().string(), program, arguments).c_str());
    return read(folder / "err");
  };
  const std::string one = err("run " + hexapod + " --set duration=2000 --set trace.period=1");
  EXPECT_EQ(advised(one), advice) << one;
  EXPECT_TRUE(contains(one, "takes about ")) << one;
  const std::string swap = err("swap " + hexapod + " --cpg tripod --set duration=2000 --set trace.period=1");
  EXPECT_EQ(advised(swap), advice) << swap;
  EXPECT_EQ(advised(err("run " + hexapod + " --quiet --out quiet --set duration=2000 --set trace.period=1")), "");
}

}  // namespace
}  // namespace gaitlab::test
