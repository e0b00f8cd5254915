// Tests of the estimated CPU time of a run, and of the advice to take the faster engine.
#include "app/run_time.h"

#include <sys/resource.h>

#include "tests/cpu_time.h"
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongRunTime(
    "FasterEngine.OtherCommandsNameItOnce:RunTimes.EstimatesAgreeWithTheCpuTimeOfCommands:FasterEngine."
    "RunAndSwapNameItBeforeTheRuns:RunTimes.EstimatesAgreeWithTheCpuTime",
    "long");

using app::estimated_seconds;

/// Measured over estimated CPU time of the shipped scenarios with one engine, over `duration` s.
std::vector<double> measured_over_estimated(const std::string& engine, const std::string& duration) {
  std::vector<double> ratios;
  for (const std::string name : {"caterpillar", "hexapod", "octopod", "pendulum", "rubble", "library/y1-snake"}) {
    std::vector<std::string> sets{"duration=" + duration, "physics.estimate=off"};
    const bool stated = name == "octopod" || name == "library/y1-snake";  // have an accuracy, which engine bullet refuses
    if (!stated) sets.push_back("physics.engine=" + engine);
    if (stated && engine == "bullet") continue;
    const Scenario s = shipped(name + ".yaml", sets);
    Simulation simulation({&s, 1}, {Loads::left_out, false});
    const double start = cpu_time();
    simulation.run();
    Scenario none = s;
    none.duration = 1e-9;  // only the constant part, which the loop over the steps does not have
    ratios.push_back((cpu_time() - start) / (estimated_seconds(s) - estimated_seconds(none)));
  }
  return ratios;
}

/// Each estimate is within a factor of two of the CPU time on the machine whose costs are in the table. Another machine, or
/// instrumented code, multiplies all CPU times of an engine by about the same factor, so that they differ by at most 4.
void expect_within_factor_two(const std::vector<double>& ratios) {
  const auto [least, most] = std::ranges::minmax(ratios);
  EXPECT_LT(most / least, 4) << fmt::format("{}", fmt::join(ratios, " "));
}

TEST(RunTimes, EstimatesAgreeWithTheCpuTime) {
  expect_within_factor_two(measured_over_estimated("bullet", "0.9"));
  expect_within_factor_two(measured_over_estimated("articulated", "6"));
}

/// CPU time of a call of the program, s.
double cpu_of_call(const std::string& arguments, const Folder& folder) {
  const auto children = [] {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  };
  const double before = children();
  EXPECT_EQ(gaitlab(arguments, folder / "").code, 0) << arguments;
  return children() - before;
}

/// Whole commands: runs with their files, and sweeps, whose lanes save less than their number, because ticks, statistics and
/// verdicts are computed for each lane.
TEST(RunTimes, EstimatesAgreeWithTheCpuTimeOfCommands) {
  const Folder folder;
  std::vector<double> ratios;
  for (const std::string name : {"caterpillar", "hexapod"}) {
    const std::string of = "'" + kScenarios + name + ".yaml' --set physics.engine=articulated --set duration=8 --quiet --out ";
    const Scenario s = shipped(name + ".yaml", {"physics.engine=articulated", "duration=8"});
    ratios.push_back(cpu_of_call("run " + of + "run-" + name, folder) / estimated_seconds(s));
    ratios.push_back(cpu_of_call("sweep " + of + "sweep-" + name + " --grid cpg.frequency=0.4:0.5:8 -j 1", folder) /
                     (8 * app::estimated_seconds_in_study(s)));
  }
  expect_within_factor_two(ratios);
}

TEST(RunTimes, TheTableHasEveryEngineAndIntegrator) {
  for (const std::string& engine : catalog().engines()) {
    for (const std::string& integrator : catalog().engine(engine)->integrator_names()) {
      const Scenario s = shipped("pendulum.yaml", {"physics.engine=" + engine, "physics.integrator=" + integrator,
                                                   integrator == "adaptive" ? "physics.step=auto" : "physics.step=1e-4"});
      EXPECT_GT(estimated_seconds(s), 0.08) << engine << " " << integrator;
    }
  }
  EXPECT_GT(estimated_seconds(shipped("hexapod.yaml", {"contact.law=bullet"})), 0.5);
}

TEST(RunTimes, GrowsWithDurationAndWithFinerSteps) {
  const auto of = [](const std::vector<std::string>& sets) { return estimated_seconds(shipped("caterpillar.yaml", sets)); };
  EXPECT_NEAR(of({"duration=40"}) - of({"duration=20"}), of({"duration=60"}) - of({"duration=40"}), 1e-9);
  EXPECT_GT(of({"physics.step=2.5e-5"}), 1.8 * of({}));
  EXPECT_GT(of({"physics.engine=articulated", "physics.accuracy=0.001"}), 2 * of({"physics.engine=articulated"}));
  EXPECT_GT(of({}), 5 * of({"physics.engine=articulated"}));
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
    const std::size_t at = text.find("engine articulated: about ");
    if (at == std::string::npos) return "";
    const std::size_t open = text.find("(--set ", at), close = text.find(')', open);
    return text.substr(open + 1, close - open - 1);
  }
  const std::string hexapod = "'" + kScenarios + "hexapod.yaml'";
};

TEST_F(FasterEngine, CheckNamesIt) {
  const Result first = check(hexapod);
  EXPECT_EQ(advised(first.out), "--set physics.engine=articulated") << first.out;
  EXPECT_EQ(first.out, check(hexapod).out);  // reads no clock
  // The advice, followed, is not given again.
  EXPECT_EQ(advised(check(hexapod + " --set physics.engine=articulated").out), "");
}

TEST_F(FasterEngine, WithAStatedStepAndIntegrator) {
  EXPECT_EQ(advised(check(hexapod + " --set physics.step=2e-5").out),
            "--set physics.engine=articulated --set physics.step=auto");
  EXPECT_EQ(advised(check(hexapod + " --set physics.step=1e-5 --set physics.integrator=rk4").out),
            "--set physics.engine=articulated --set physics.step=auto --set physics.integrator=adaptive");
}

TEST_F(FasterEngine, OnlyWhereItHelps) {
  EXPECT_EQ(advised(check(hexapod + " --set duration=2").out), "");                                     // below 5 s
  EXPECT_EQ(advised(check(hexapod + " --set contact.law=bullet --set duration=200").out), "");          // which only bullet has
  EXPECT_EQ(advised(check("'" + kScenarios + "library/y1-rolling.yaml' --set duration=200").out), "");  // has it
}

/// Every command says it once, before its runs; --quiet leaves it out.
TEST_F(FasterEngine, OtherCommandsNameItOnce) {
  const Folder folder;
  const auto err = [&](const std::string& arguments) { return gaitlab(arguments, folder / "").err; };
  const std::string sweep = err("sweep " + hexapod + " --grid cpg.frequency=0.4:0.6:3 --dry-run --set duration=0.2 -j 1");
  EXPECT_EQ(advised(sweep), "");
  // 600 runs of 0.2 s; a dry run simulates only eight of them.
  const std::string many = err("sweep " + hexapod + " --grid cpg.frequency=0.4:0.6:600 --dry-run --set duration=0.2 -j 1");
  EXPECT_EQ(advised(many), "--set physics.engine=articulated") << many;
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
  EXPECT_EQ(advised(one), "--set physics.engine=articulated") << one;
  EXPECT_TRUE(contains(one, "takes about 1")) << one;
  const std::string swap = err("swap " + hexapod + " --cpg tripod --set duration=2000 --set trace.period=1");
  EXPECT_EQ(advised(swap), "--set physics.engine=articulated") << swap;
  EXPECT_EQ(advised(err("run " + hexapod + " --quiet --out quiet --set duration=2000 --set trace.period=1")), "");
}

}  // namespace
}  // namespace gaitlab::test
