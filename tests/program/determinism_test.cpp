// With the same build, the same scenario gives the same bytes. After the start, steps do not allocate memory.
#include <locale>

#include "core/recording/trace.h"
#include "core/scenario/resolved.h"
#include "tests/labels.h"
#include "tests/program/allocations.h"
#include "tests/program/engines.h"

namespace gaitlab::test {
namespace {

const Label kLongDeterminism("*DeterminismOf.AllocatesNothingInTheSteadyState/*", "long");

TEST(Determinism, OtherFolderOtherTimeSameBytes) {
  const Folder one;
  const Folder two;
  const std::string run = "run '" + kScenarios + "caterpillar.yaml' --set duration=0.6 --quiet --out ";
  ASSERT_EQ(gaitlab(run + "a", one / "").code, 0);
  ASSERT_EQ(gaitlab(run + "some/where/b", two / "").code, 0);
  for (const char* file : {"trace.h5", "scenario.resolved.yaml"}) {
    EXPECT_EQ(read(one / (std::string("a/") + file)), read(two / (std::string("some/where/b/") + file))) << file;
  }
  // The resolved scenario gives the same trace and the same resolved scenario, also in a folder without module files.
  ASSERT_EQ(gaitlab("run '" + (one / "a/scenario.resolved.yaml") + "' --quiet --out c", two / "").code, 0);
  EXPECT_EQ(read(one / "a/trace.h5"), read(two / "c/trace.h5"));
  EXPECT_EQ(read(one / "a/scenario.resolved.yaml"), read(two / "c/scenario.resolved.yaml"));
}

/// Number format of a locale that writes 0,5 for 0.5 and 1.000 for 1000.
struct Comma final : std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

TEST(Determinism, OtherLocaleSameBytes) {
  const auto texts = [] {
    const Scenario s = shipped("caterpillar.yaml", {"duration=0.1"});
    return std::pair(resolved(s), hash(run(s).trace));
  };
  const auto plain = texts();
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const auto german = texts();
  std::locale::global(before);
  EXPECT_EQ(plain, german);
}

/// CPG with feedback, whose set points depend on the measured torques and contacts.
struct Feeling final : Cpg {
  struct Settings {
    void fields(Fields&) {}
  };
  Feeling(const RobotInfo& robot, const Settings&) : n(robot.joints.size()) {}
  [[nodiscard]] std::size_t states() const override { return n; }
  void derivative(const Measured& m, In, Out rate) const override {
    for (std::size_t i = 0; i < n; ++i) rate[i] = 0.3 + 5 * m.torque[i] + m.touching[i / 2];
  }
  void output(double, In x, Out setpoint) const override {
    for (std::size_t i = 0; i < n; ++i) setpoint[i] = 0.3 * x[i];
  }
  std::size_t n;
};

class DeterminismOf : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Engine, DeterminismOf, engines(), engine_name);

TEST_P(DeterminismOf, SnapshotGoesOnInAnotherWorldWhateverTheCpgMeasures) {
  if (catalog().find(Kind::cpg, "feeling") == nullptr) add_cpg<Feeling>(catalog(), "feeling", "a test's");
  const Scenario s = shipped("caterpillar.yaml", {"duration=2.1", "cpg.type=feeling", set()});
  const auto go = [](Simulation& simulation, int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
    return std::vector<double>(simulation.state().begin(), simulation.state().end());
  };
  Simulation first({&s, 1});
  const std::vector<double> snapshot = go(first, 1200);
  const std::vector<double> end = go(first, 3000);
  Simulation second({&s, 1});
  std::copy(snapshot.begin(), snapshot.end(), second.state().begin());
  EXPECT_EQ(go(second, 3000), end);
}

/// CPG with the state x' = cos(2 t). RK4 has order 4 only if each stage uses its own time.
struct Clock final : Cpg {
  struct Settings {
    void fields(Fields&) {}
  };
  Clock(const RobotInfo& robot, const Settings&) : n(robot.joints.size()) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void derivative(const Measured& m, In, Out rate) const override { rate[0] = math::cos(2 * m.t); }
  void output(double, In, Out setpoint) const override { std::fill(setpoint.begin(), setpoint.end(), 0.0); }
  std::size_t n;
};

TEST(Simulation, CpgStatesAreIntegratedToFourthOrder) {
  add_cpg<Clock>(catalog(), "clock", "a test's");
  const Recording record = run(shipped("caterpillar.yaml", {"duration=0.6", "cpg.type=clock", "trace.columns=[cpg.*]"}));
  // For this equation RK4 is Simpson's rule. Its error at 15 ms is at most h^4 / 2880 * max |16 cos(2t)| * 0.6 s = 1.7e-10.
  EXPECT_NEAR(Table(record.trace)(0.6, "cpg.0"), 0.5 * math::sin(1.2), 2e-10);
}

TEST_P(DeterminismOf, SnapshotGoesOnAsIfNothingHadHappened) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=1", set()});
  Simulation simulation({&s, 1});
  for (int i = 0; i < 1000; ++i) simulation.step();
  const std::vector<double> snapshot(simulation.state().begin(), simulation.state().end());
  for (int i = 0; i < 1000; ++i) simulation.step();
  const std::vector<double> first(simulation.state().begin(), simulation.state().end());
  std::copy(snapshot.begin(), snapshot.end(), simulation.state().begin());
  for (int i = 0; i < 1000; ++i) simulation.step();
  EXPECT_TRUE(std::equal(first.begin(), first.end(), simulation.state().begin()));
}

TEST_P(DeterminismOf, AllocatesNothingInTheSteadyState) {
  // Undamped feet on stiff ground chatter, so that the integrator divides steps to the smallest size.
  const std::vector<std::string> stiff{"contact.stiffness=1e6", "contact.damping=0"};
  for (const auto& [file, more] : {std::pair("caterpillar.yaml", std::vector<std::string>()),
                                   {"hexapod.yaml", {}},
                                   {"rubble.yaml", {}},
                                   {"hexapod.yaml", stiff}}) {
    for (const std::size_t lanes : catalog().engine(GetParam())->lanes) {
      std::vector<std::string> sets{"duration=12", set()};  // more than the 2000 steps of up to 5 ms below
      sets.insert(sets.end(), more.begin(), more.end());
      const std::vector<Scenario> s(lanes, shipped(file, sets));
      Simulation simulation(s);
      for (int i = 0; i < 1000; ++i) simulation.step();  // during the first ticks, Bullet allocates its buffers
      const Allocations allocations;
      for (int i = 0; i < 1000; ++i) simulation.step();  // includes trace rows and control ticks
      EXPECT_EQ(allocations.count(), 0) << file << ", " << lanes << " lanes";
    }
  }
}

}  // namespace
}  // namespace gaitlab::test
