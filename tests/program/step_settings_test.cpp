// Settings of the steps: reading, printing and halving of physics.step, integrator and accuracy.
#include <regex>

#include "core/recording/convergence.h"
#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const std::string kHead = "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.3\n";

Physics physics(const std::string& keys) { return scenario(kHead + "physics: {" + keys + "}\n").physics; }

/// Output of `gaitlab check`.
std::string error(const std::string& keys, const std::string& more = "") {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  folder.write("s.yaml", kHead + "physics: {" + keys + "}\n" + more);
  const Result result = gaitlab("check s.yaml", folder / "");
  EXPECT_EQ(result.code, result.err.empty() ? 0 : 2);
  return result.err;
}

TEST(StepSettings, LeaveTheStepToTheAdaptiveIntegrator) {
  for (const char* keys :
       {"engine: articulated", "engine: articulated, step: auto", "engine: articulated, integrator: adaptive",
        "engine: articulated, step: auto, integrator: adaptive, accuracy: 0.01"}) {
    const Physics p = physics(keys);
    EXPECT_TRUE(p.adaptive_step) << keys;
    EXPECT_TRUE(p.adapts()) << keys;
    EXPECT_EQ(p.integrator->name, "adaptive") << keys;
    EXPECT_EQ(p.step, 0.005) << keys;  // a third of the control period of 15 ms
    EXPECT_EQ(p.accuracy, 0.01) << keys;
  }
}

TEST(StepSettings, ANumberAsksForTheIntegratorOfFirstOrder) {
  const Physics p = physics("engine: articulated, step: 1e-3");
  EXPECT_EQ(p.integrator->name, "implicit");
  EXPECT_FALSE(p.adaptive_step);
  EXPECT_EQ(p.step, 1e-3);
  EXPECT_EQ(physics("engine: articulated, integrator: implicit").step, 5e-4);
  EXPECT_EQ(physics("engine: bullet, step: 2e-5").integrator->name, "semi_implicit");
  EXPECT_EQ(physics("engine: bullet").integrator->name, "adaptive");
  EXPECT_EQ(physics("engine: bullet, integrator: implicit").step, 5e-4) << "no limit of stability";
  EXPECT_EQ(physics("engine: bullet, integrator: semi_implicit").step, 2.5e-5);
}

TEST(StepSettings, TheAdaptiveIntegratorTakesANumberForItsLongestStep) {
  const Physics p = physics("engine: articulated, integrator: adaptive, step: 2.5e-3, accuracy: 1e-3");
  EXPECT_TRUE(p.adapts());
  EXPECT_FALSE(p.adaptive_step);
  EXPECT_EQ(p.step, 2.5e-3);
  EXPECT_EQ(p.accuracy, 1e-3);
  const Scenario s = scenario(kHead + "physics: {engine: articulated, integrator: adaptive, step: 2.5e-3}\n");
  EXPECT_EQ(run(s).steps, 120);
}

/// The default step is the largest integer fraction of the control period up to 5 ms. It does not depend on trace rows.
TEST(StepSettings, AStepIsAWholeShareOfTheControlPeriod) {
  for (const auto& [period, step] : std::vector<std::pair<std::string, double>>{{"0.015", 0.005},
                                                                                {"0.005", 0.005},
                                                                                {"0.0051", 0.00255},
                                                                                {"0.001", 0.001},
                                                                                {"0.016", 0.004},
                                                                                {"0.0113", 0.0113 / 3}}) {
    for (const char* rows : {"5e-3", "7e-3", "1e-4"}) {
      const Scenario s = scenario(kHead + "cpg: {type: sine}\ncontroller: {period: " + period +
                                  "}\nphysics: {engine: articulated}\ntrace: {period: " + rows + "}\n");
      EXPECT_DOUBLE_EQ(s.physics.step, step) << period;
    }
  }
}

TEST(StepSettings, AutoIsRefusedWhereNothingChoosesSteps) {
  EXPECT_EQ(error("engine: bullet, step: auto", "contact: {law: bullet, on: all}\n"),
            "s.yaml:4:33: error: integrator 'semi_implicit' of engine 'bullet' cannot choose the step; expected a number of "
            "seconds\n");
  for (const char* integrator : {"implicit", "extrapolated", "rk4"}) {
    const std::string text = error(fmt::format("engine: articulated, integrator: {}, step: auto", integrator));
    EXPECT_TRUE(
        contains(text, fmt::format("error: integrator '{}' of engine 'articulated' cannot choose the step; expected a number "
                                   "of seconds, or integrator: adaptive\n",
                                   integrator)))
        << text;
    EXPECT_TRUE(text.starts_with("s.yaml:4:")) << text;
  }
  EXPECT_EQ(error("engine: articulated, step: often"),
            "s.yaml:4:38: error: step is 'often'; expected a number in s, or auto\n");
  EXPECT_EQ(error("engine: articulated, step: 0"), "s.yaml:4:38: error: step is 0 s; expected 1e-09 to 1 s\n");
}

/// Shipped scenario with the explicit integrator of engine bullet, which chooses its step.
Scenario explicit_run(const std::string& name, std::vector<std::string> sets = {}) {
  sets.insert(sets.begin(), "physics.integrator=semi_implicit");
  return shipped(name, sets);
}

double h_lambda(const Scenario& s) { return s.physics.step * Simulation({&s, 1}).standing().rate; }

/// The step of an explicit integrator is the longest of a series, up to 5e-5 s, with h lambda of at most 0.8, and of at most
/// 0.45 for contacts.
TEST(StepSettings, BulletChoosesTheLongestStepThatIsStable) {
  const Scenario caterpillar = explicit_run("caterpillar.yaml");
  EXPECT_EQ(caterpillar.physics.step, 5e-5);
  EXPECT_LT(h_lambda(caterpillar), 0.8) << "its motors set it";
  const Scenario hexapod = explicit_run("hexapod.yaml");
  EXPECT_EQ(hexapod.physics.step, 2.5e-5);
  EXPECT_LT(h_lambda(hexapod), 0.45) << "its feet set it";
  EXPECT_GT(2 * h_lambda(hexapod), 0.45);
  const Scenario stiff = explicit_run("caterpillar.yaml", {"actuator.gear=3000"});
  EXPECT_LT(stiff.physics.step, 1e-5) << "was refused, with a step to write";
  EXPECT_LE(h_lambda(stiff), 0.8);
  EXPECT_GT(2.5 * h_lambda(stiff), 0.8);
  EXPECT_EQ(explicit_run("caterpillar.yaml", {"physics.step=auto"}).physics.step, 5e-5);
  EXPECT_EQ(explicit_run("caterpillar.yaml", {"physics.step=2.5e-5"}).physics.step, 2.5e-5);
  EXPECT_EQ(explicit_run("pendulum.yaml", {"physics.engine=bullet", "physics.step=auto"}).physics.step, 5e-5)
      << "nothing limits it";
}

TEST(StepSettings, AStepThatBulletChoosesDividesThePeriods) {
  EXPECT_EQ(explicit_run("caterpillar.yaml", {"trace.period=0.00499"}).physics.step, 1e-5);
  EXPECT_EQ(explicit_run("caterpillar.yaml", {"trace.period=2e-5"}).physics.step, 2e-5);
  EXPECT_EQ(error("engine: bullet, integrator: semi_implicit", "trace: {period: 0.0049999999}\n").substr(0, 23),
            "s.yaml:5:17: error: tra");
}

/// The step of an explicit integrator follows from the settings of each point, as `sweep` creates them.
TEST(StepSettings, AStepThatBulletChoosesFollowsWhatIsSet) {
  const ScenarioTemplate caterpillar(kScenarios + "caterpillar.yaml", {"physics.integrator=semi_implicit"}, catalog());
  EXPECT_EQ(caterpillar.with({"cpg.amplitude=0.3"}).physics.step, 5e-5);
  EXPECT_EQ(caterpillar.with({"actuator.gear=3000"}).physics.step,
            explicit_run("caterpillar.yaml", {"actuator.gear=3000"}).physics.step);
  EXPECT_EQ(caterpillar.with({"trace.period=2e-5"}).physics.step, 2e-5);
}

TEST(StepSettings, AccuracyIsANumberWithinItsRange) {
  for (const char* wrong : {"0", "-0.01", "1e-07", "0.6", "1"}) {
    EXPECT_EQ(error(fmt::format("engine: articulated, accuracy: {}", wrong)),
              fmt::format("s.yaml:4:42: error: accuracy is {}; expected 1e-06 to 0.5\n", wrong));
  }
  EXPECT_EQ(error("engine: articulated, accuracy: 1e-6"), "");
  EXPECT_EQ(error("engine: articulated, accuracy: 0.5"), "");
}

/// The setting `accuracy` is refused for integrators with a fixed step, because it would have no effect.
TEST(StepSettings, AccuracyIsForIntegratorsThatChooseTheirSteps) {
  for (const char* keys : {"engine: articulated, integrator: implicit, accuracy: 0.01",
                           "engine: articulated, step: 1e-3, accuracy: 0.01", "engine: bullet, step: 2e-5, accuracy: 0.01"}) {
    const std::string text = error(keys);
    EXPECT_TRUE(contains(text, " uses the given step and ignores accuracy; remove accuracy, or use integrator: adaptive\n"))
        << text;
  }
}

TEST(StepSettings, APeriodThatNoFixedStepFitsIsStillRefused) {
  EXPECT_TRUE(contains(error("engine: articulated, step: 1e-3", "trace: {period: 1.5e-3}\n"),
                       "trace period 0.0015 s is not a whole multiple of the step 0.001 s"));
  EXPECT_EQ(error("engine: articulated", "trace: {period: 1.5e-3}\n"), "");
}

TEST(StepSettings, ResolvedSaysThemAndIsItself) {
  const std::string motor = "cpg: {type: sine}\n";
  for (const auto& [keys, expected] : std::vector<std::pair<std::string, std::string>>{
           {"engine: articulated", "  step: auto\n  integrator: adaptive\n  accuracy: 0.01\n"},
           {"engine: articulated, accuracy: 2e-3", "  step: auto\n  integrator: adaptive\n  accuracy: 0.002\n"},
           {"engine: articulated, integrator: adaptive, step: 5e-3",
            "  step: 0.005\n  integrator: adaptive\n  accuracy: 0.01\n"},
           {"engine: articulated, step: 1e-3", "  step: 0.001\n  integrator: implicit\n  gravity"},
           {"engine: bullet", "  step: auto\n  integrator: adaptive\n  accuracy: 0.01\n"},
           {"engine: bullet, integrator: semi_implicit", "  step: 2.5e-05\n  integrator: semi_implicit\n  gravity"}}) {
    const Scenario s = scenario(kHead + motor + "physics: {" + keys + "}\n");
    const std::string text = resolved(s);
    EXPECT_TRUE(contains(text, expected)) << keys << "\n" << text;
    const Folder folder;
    const Scenario again = read_scenario(folder.write("again.yaml", text), {}, catalog());
    EXPECT_EQ(resolved(again), text) << keys;
    EXPECT_EQ(again.physics.adaptive_step, s.physics.adaptive_step);
    EXPECT_EQ(hash(run(again).trace), hash(run(s).trace)) << keys;
  }
}

TEST(StepSettings, RefiningDividesWhatChoosesTheSteps) {
  Physics p = physics("engine: articulated");
  p.refine(4);
  EXPECT_EQ(p.accuracy, 0.0025);
  EXPECT_EQ(p.step, 0.005);
  p = physics("engine: articulated, step: 1e-3");
  p.refine(4);
  EXPECT_EQ(p.step, 2.5e-4);
}

struct Converge : testing::Test {
  /// Output of `gaitlab converge` with these arguments.
  [[nodiscard]] std::string of(const std::string& arguments) const {
    const Result r = gaitlab("converge " + arguments + " --quiet -j 2", folder / "");
    EXPECT_EQ(r.code, 0) << r.err;
    return r.out;
  }
  Folder folder;
};

TEST_F(Converge, HalvesTheAccuracy) {
  const std::string text = of("'" + kScenarios + "caterpillar.yaml' --set physics.engine=articulated --set duration=0.6");
  EXPECT_TRUE(contains(text, "caterpillar-8: error against accuracy 0.0025 (RMS over the rows")) << text;
  EXPECT_TRUE(std::regex_search(text, std::regex("\naccuracy +0[.]01 +0[.]005 +order\n"))) << text;
  EXPECT_TRUE(contains(text, "\naccuracy 0.01 is accurate to 1 %: the error is at most ")) << text;
  EXPECT_FALSE(contains(text, " s is good")) << text;
  // The errors in the table equal the errors of separate runs with these accuracies.
  std::vector<Trace> traces;
  for (const char* accuracy : {"0.01", "0.005", "0.0025"}) {
    traces.push_back(run(shipped("caterpillar.yaml",
                                 {"physics.engine=articulated", "duration=0.6", std::string("physics.accuracy=") + accuracy}))
                         .trace);
  }
  const std::vector<ConvergenceRow> rows = convergence(traces, {"joint.3.torque"});
  ASSERT_EQ(rows.size(), 1U);
  const std::string row =
      fmt::format("{:<24} {:>10.2g} % {:>10.2g} %", rows[0].name, 100 * rows[0].error[0], 100 * rows[0].error[1]);
  EXPECT_TRUE(contains(text, "\n" + row)) << row << "\n" << text;
}

/// On stiff ground the errors do not decrease with a power of the step, because impacts are shorter than a step. The program
/// then reports no order.
TEST_F(Converge, SaysThatNoOrderIsSeen) {
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  folder.write(
      "s.yaml",
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 1], [1, 2, 4, 1, 3], [0, 3, 3, 0, 3], [2, 4, 5, 0, 1], [0, 5, "
      "3, 2, 3], [2, 6, 5, 2, 1]]}\nphysics: {engine: articulated, step: 2.5e-3}\ncontact: {stiffness: 1e6, damping: "
      "1e7}\ncpg: {type: tripod}\nduration: 0.6\n");
  const std::string text = of("s.yaml");
  EXPECT_TRUE(contains(text, "no value that was tried is both allowed and accurate to 1 % of joint.")) << text;
  EXPECT_TRUE(std::regex_search(
      text,
      std::regex("; the (observed order, 0[.][0-4][0-9]?, is too low|order is not clear enough) to predict other values\n")))
      << text;
  EXPECT_FALSE(contains(text, "by the observed order")) << text;
}

}  // namespace
}  // namespace gaitlab::test
