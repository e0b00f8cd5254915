// The caterpillar walks with every oscillator, if only `cpg.type` is changed.
#include <cmath>
#include <numbers>

#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// Whole walks under every CPG.
const Label kWalksUnder("Walk/WalkUnder.*", "long;unsanitized");

struct Gait {
  double period = 0, lag = 0, travel = 0;
};

/// Gait of the caterpillar during the period of 4 s after t = 3.5 s, when the amplitudes have grown. Only engine articulated is
/// used, because the oscillators do not depend on the engine.
Gait walk_under(const std::string& type, double lag) {
  constexpr double kFrom = 3.5, kUntil = 8;
  std::vector<std::string> sets{"cpg.type=" + type, fmt::format("cpg.phase_lag={}", lag), "duration=8",
                                "physics.engine=articulated"};
  if (type == "wave") sets.push_back("plugins=[" + std::string(gaitlab::test::build_folder()) + "/plugins/wave.so]");
  const Recording record = run(shipped("caterpillar.yaml", sets));
  const Table table(record.trace);
  std::vector<std::vector<double>> rises(16);  // by joint: times at which the angle rises through 0
  for (std::size_t j = 0; j < 16; ++j) {
    const std::string column = fmt::format("joint.{}.angle", j);
    const auto first = static_cast<std::size_t>(kFrom / 0.005);
    double before = table.at(first, column);
    for (std::size_t row = first + 1; row <= static_cast<std::size_t>(kUntil / 0.005); ++row) {
      const double now = table.at(row, column);
      if (before < 0 && now >= 0) rises[j].push_back(0.005 * (static_cast<double>(row) - now / (now - before)));
      before = now;
    }
  }
  Gait gait;
  int periods = 0;
  double sine = 0, cosine = 0;
  for (std::size_t j = 0; j < 16; ++j) {
    EXPECT_FALSE(rises[j].empty()) << j;
    if (rises[j].size() == 2) {
      gait.period += rises[j][1] - rises[j][0];
      ++periods;
    }
    if (j == 0 || rises[j].empty()) continue;
    const double lead = 2 * std::numbers::pi / 4 * (rises[j - 1][0] - rises[j][0]);
    sine += std::sin(lead);
    cosine += std::cos(lead);
  }
  gait.period /= periods;
  gait.lag = std::atan2(sine, cosine);
  gait.travel = table(7.5, "com.x") - table(3.5, "com.x");
  std::printf("%s, lag %g: period %.3f s, lag %.3f, %.4f m in 4 s\n", type.c_str(), lag, gait.period, gait.lag, gait.travel);
  return gait;
}

class WalkUnder : public ::testing::TestWithParam<const char*> {};

TEST_P(WalkUnder, TheCaterpillarTravelsAndTurnsBackWithTheLagsSign) {
  const Gait ahead = walk_under(GetParam(), 1.2);
  EXPECT_NEAR(ahead.period, 4, 0.04);  // tolerances of the plugin interface for CPGs
  EXPECT_NEAR(ahead.lag, 1.2, 0.05);
  EXPECT_LT(ahead.travel, -0.05);
  const Gait back = walk_under(GetParam(), -1.2);
  EXPECT_NEAR(back.period, 4, 0.04);
  EXPECT_NEAR(back.lag, -1.2, 0.05);
  EXPECT_GT(back.travel, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Walk, WalkUnder,
                         ::testing::Values("phase_oscillator", "kuramoto_amplitude", "hopf", "matsuoka", "van_der_pol",
                                           "equations", "wave"),
                         [](const auto& param) { return std::string(param.param); });

/// Outcome of a run of one module with a CPG of the equations `model`.
std::string end_of_run(const std::string& model) {
  const Scenario s =
      scenario("gaitlab: 1\nrobot: {modules: mtran}\nduration: 0.1\ncpg:\n  type: equations\n  model:\n" + model);
  try {
    run(s);
  } catch (const SimulationError& error) {
    return error.where + " | " + error.what();
  }
  return "no error";
}

TEST(EquationRuns, ThatLeaveTheNumbersNameJointAndState) {
  EXPECT_EQ(end_of_run("    states: {a: 0, y: \"if(index == 1 and t > 0.02, log(a - 1), 1)\"}\n    output: a\n"),
            "m0/passive | diverged at step 3, t = 0.015 s: joint m0/passive: the CPG's state y is nan");
  EXPECT_EQ(end_of_run("    states: {}\n    output: if(t < 0.04, 0, 1/(index - 1))\n"),
            "m0/passive | diverged at step 9, t = 0.045 s: joint m0/passive: the CPG's set point is inf");
}

TEST(EquationRuns, TheFileWithItsEquationsWalksAsTheNativeModel) {
  const Recording native =
      run(shipped("caterpillar.yaml", {"duration=1", "physics.engine=articulated", "physics.accuracy=0.001"}));
  const Recording written = run(shipped("caterpillar-equations.yaml", {"duration=1", "physics.accuracy=0.001"}));
  ASSERT_EQ(native.trace.rows(), 201U);
  EXPECT_EQ(native.trace.values, written.trace.values);  // identical bits, because the operations have the same order
}

}  // namespace
}  // namespace gaitlab::test
