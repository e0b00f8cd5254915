// Loads of docks and feet equal closed forms and the reaction columns, and recording them does not change the run.
#include "report/analysis/loads.h"

#include <cmath>

#include "core/model/pattern.h"
#include "core/recording/recording_file.h"
#include "report/verdict/checks/loads.h"
#include "tests/oracles/blocks.h"
#include "tests/program/block.h"
#include "tests/program/dense_bending.h"
#include "tests/program/engines.h"
#include "tests/program/random_scenario.h"

namespace gaitlab::test {
namespace {

// Loads are recorded with the 24 bits of a float, so that the rounding error is up to 6e-8 of the value. The tolerance is
// double.
constexpr double kFloat = 1.2e-7;

Recording run_with_loads(const Scenario& scenario) {
  Simulation simulation({&scenario, 1}, Loads::recorded);
  simulation.run();
  return simulation.take_recording(0);
}

double load(const Recording& record, std::size_t row, const std::string& column) { return Table(record.loads).at(row, column); }
double last_load(const Recording& record, const std::string& column) { return load(record, record.loads.rows() - 1, column); }

class LoadsOf : public EveryEngine {
 protected:
  /// Run of rods of 0.5 kg and 0.2 m that are docked at ends and sides. The first rod is fixed in the air.
  [[nodiscard]] static Recording rods(const std::string& docks, double pitch) {
    return run_with_loads(scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 1]
  orientation: [0, {:.17g}, 0]
  docks: {}
  modules:
    name: rod
    bodies: {{rod: {{mass: 0.5, inertia: [0.001, 0.001, 0.001, 0, 0, 0]}}}}
    faces:
      - {{id: 0, body: rod, gender: active, origin: [-0.1, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}}
      - {{id: 1, body: rod, gender: passive, origin: [0.1, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}}
      - {{id: 2, body: rod, gender: passive, origin: [0, 0.03, 0], normal: [0, 1, 0], reference: [1, 0, 0]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{engine: {}}}
duration: 0.03
trace: {{columns: [base.*]}}
)",
                                               pitch, docks, GetParam())));
  }
  static void expect(const Recording& record, int module, double tension, double shear, double bending, double torsion) {
    const auto at = [&](const char* quantity) { return last_load(record, fmt::format("dock.{}.{}", module, quantity)); };
    constexpr double kTolerance = 1e-6;  // kFloat times 10 N, rounded
    EXPECT_NEAR(at("tension"), tension, kTolerance);
    EXPECT_NEAR(at("shear"), shear, kTolerance);
    EXPECT_NEAR(at("bending"), bending, kTolerance);
    EXPECT_NEAR(at("torsion"), torsion, kTolerance);
  }
  static constexpr double kWeight = 0.5 * 9.81;
  static constexpr const char* kRow = "[[0, 1, 1, 0, 0], [0, 2, 1, 1, 0]]";
};
INSTANTIATE_TEST_SUITE_P(Of, LoadsOf, engines(), engine_name);

TEST_P(LoadsOf, ARodThatHangsAndOneThatStands) {
  const Recording hangs = rods(kRow, std::numbers::pi / 2);  // the x axis points downwards
  expect(hangs, 1, 2 * kWeight, 0, 0, 0);
  expect(hangs, 2, kWeight, 0, 0, 0);
  const Recording stands = rods(kRow, -std::numbers::pi / 2);
  expect(stands, 1, -2 * kWeight, 0, 0, 0);
}

TEST_P(LoadsOf, AnArmThatIsHeldOut) {
  const Recording record = rods(kRow, 0);
  expect(record, 1, 0, 2 * kWeight, kWeight * (0.1 + 0.3), 0);
  expect(record, 2, 0, kWeight, kWeight * 0.1, 0);
}

/// The weight of a rod that is docked to the side of another rod, 0.13 m from its axis, causes torsion about the outward x
/// axis.
TEST_P(LoadsOf, ATwistedDock) {
  const Recording record = rods("[[0, 1, 1, 0, 0], [0, 2, 2, 1, 0]]", 0);
  expect(record, 1, 0, 2 * kWeight, 2 * kWeight * 0.1, kWeight * 0.13);
  expect(record, 2, 0, kWeight, kWeight * 0.1, 0);
}

/// Block of 1 kg on four contact points.
Scenario block(const std::string& engine, const std::string& rest, double height, double duration) {
  return scenario(fmt::format(R"(
gaitlab: 1
{}contact: {{on: feet}}
actuator: {{type: none}}
duration: {}
physics: {{engine: {}, step: 5e-5}}
trace: {{columns: [base.*]}}
{}
)",
                              block_robot(fmt::format("  position: [0, 0, {:.17g}]\n", height)), duration, engine, rest));
}

TEST_P(LoadsOf, ABlockThatSlidesToRest) {
  const double sink = oracle::standing_sink(1, 9.81, 4, 1e4);
  const Recording record = run_with_loads(block(GetParam(), "initial: {base_velocity: [0.6, 0.8, 0]}", -sink, 0.2));
  const oracle::SlidingBlock law{0.8, 9.81, 0.01};
  // The tolerance is for the error h v / 2 of the path of explicit methods of order 1.
  const double way = law.stops_after(1);
  EXPECT_NEAR(last_load(record, "slip"), way, 3e-5);
  EXPECT_NEAR(last_load(record, "foot.m0/block.slid"), way, 3e-5);
  EXPECT_NEAR(last_load(record, "path"), way, 3e-5);
  EXPECT_NEAR(last_load(record, "stability"), 0.1, 1e-7);
  EXPECT_NEAR(last_load(record, "foot.m0/block.fz"), 9.81, 9.81 * kFloat);
  EXPECT_NEAR(last_load(record, "foot.m0/block.x"), 0.6 * way, 3e-5);
  EXPECT_NEAR(last_load(record, "foot.m0/block.y"), 0.8 * way, 3e-5);
  EXPECT_NEAR(load(record, 1, "foot.m0/block.fx"), -0.6 * 0.8 * 9.81, 1e-5);  // friction against the motion
}

TEST_P(LoadsOf, ABlockThatFlies) {
  const Recording record = run_with_loads(block(GetParam(), "initial: {base_velocity: [1, 0, 0]}", 0.5, 0.2));
  EXPECT_NEAR(last_load(record, "path"), 0.2, 1e-6);
  EXPECT_EQ(last_load(record, "slip"), 0);
  EXPECT_TRUE(std::isnan(last_load(record, "stability"))) << "it stands on nothing";
  EXPECT_EQ(record.loads.find("foot.m0/block.fz"), record.loads.columns.size()) << "it never carried a load";
}

/// A robot with a fixed base turns an arm of 0.3 m about the vertical, with a foot at its end on the ground. The distance that
/// the foot slides is the length of its arc.
TEST_P(LoadsOf, ADraggedFoot) {
  const Recording record = run_with_loads(scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, -1e-4]
  modules:
    name: arm
    bodies:
      hub: {{mass: 1, inertia: [0.01, 0.01, 0.01, 0, 0, 0]}}
      arm: {{mass: 1, inertia: [0.02, 0.02, 0.03, 0, 0, 0]}}
    hinges: [{{name: turn, parent: hub, child: arm, origin: [0, 0, 0], axis: [0, 0, 1], range: [-3, 3]}}]
    contacts: {{feet: [{{body: arm, point: [0.3, 0, 0]}}]}}
contact: {{on: feet}}
initial: {{speeds: 2}}
actuator: {{type: none}}
duration: 0.6
physics: {{engine: {}, step: 5e-5}}
trace: {{columns: [joint.*]}}
)",
                                                               GetParam())));
  const double turned = end(record, "joint.0.angle");
  EXPECT_GT(turned, 0.1);
  const double fn = last_load(record, "foot.m0/arm.fz");
  EXPECT_NEAR(fn, 1e4 * 1e-4, 1e-6);  // Kn p
  // Ticks give chords of the arc, which are shorter by at most (0.015 s * 2 rad/s)^2 / 24.
  EXPECT_NEAR(last_load(record, "foot.m0/arm.slid"), 0.3 * turned, 4e-5 * 0.3 * turned);
  EXPECT_NEAR(last_load(record, "slip"), 0.3 * turned * fn / (2 * 9.81), 5e-5 * 0.3 * turned * fn / (2 * 9.81));
}

/// The loads of docks equal the reaction columns, resolved along and across the child's face by the pose columns. The robot has
/// no motors, so that nothing jumps at a tick, and rows of trace and loads at the same time are comparable.
TEST(Loads, AreTheReactionsInTheAxesOfTheFaces) {
  double worst = 0;
  double largest = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    RandomRobots random(seed);
    Scenario s = random_run(random, seed % 2 == 0 ? Base::floating : Base::fixed, 5, 0.2);
    s.actuator = s.controller = {};
    s.trace.columns = {"body.*", "reaction.*", "contact.*"};
    const Recording record = run_with_loads(s);
    ASSERT_GE(record.loads.rows(), 2U);
    const Robot& robot = *s.robot;
    const Table table(record.trace);
    for (std::size_t tick = 0; tick < record.loads.rows(); ++tick) {  // loads have fewer rows than the trace
      std::size_t row = 0;
      while (row + 1 < record.trace.rows() && record.trace.at(row, 0) < record.loads.at(tick, 0)) ++row;
      ASSERT_EQ(record.trace.at(row, 0), record.loads.at(tick, 0));
      const auto vec = [&](const std::string& name) {
        return Vec3(table.at(row, name + "x"), table.at(row, name + "y"), table.at(row, name + "z"));
      };
      for (std::size_t m = 1; m < robot.modules.size(); ++m) {
        const Module& module = robot.modules[m];
        const ModuleType& type = robot.types[module.type];
        const auto face = std::ranges::find(type.faces, module.dock.child_face, &FaceType::id);
        const std::string body = "body." + robot.bodies[module.first_body + face->body].name + ".q";
        const Quat turn(table.at(row, body + "w"), table.at(row, body + "x"), table.at(row, body + "y"),
                        table.at(row, body + "z"));
        const Vec3 normal = turn * face->normal;  // points out of the child into the parent
        const std::string dock = fmt::format("reaction.m{}/dock.", m);
        const Vec3 f = vec(dock + "f");
        const Vec3 moment = vec(dock + "m");
        // Each row after the first has the largest loads since the previous row.
        const auto compare = [&](const char* quantity, double by_hand) {
          const double got = load(record, tick, fmt::format("dock.{}.{}", m, quantity));
          const bool of_magnitude = quantity == std::string("torsion");
          const double less = of_magnitude ? std::abs(by_hand) - std::abs(got) : by_hand - got;
          worst = std::max(worst, (tick == 0 ? std::abs(got - by_hand) : less) / (1 + f.norm() + moment.norm()));
          largest = std::max(largest, std::abs(by_hand));
        };
        compare("tension", f.dot(normal));
        compare("shear", f.cross(normal).norm());
        compare("bending", moment.cross(normal).norm());
        compare("torsion", -moment.dot(normal));
      }
    }
  }
  EXPECT_GT(largest, 1);
  EXPECT_LT(worst, 1e-6) << "a float's rounding, and Bullet's, 1e-10 of the contact forces";
}

/// Two docked rods fall on one end. The dock is bent most between two control ticks, by an impact of some milliseconds. The
/// largest loads agree with dense reaction columns up to the change by an impact between two samples (1 ms apart with a given
/// step, eighths of a divided step).
TEST_P(LoadsOf, AnImpactBetweenTicks) {
  const Recording record = run_with_loads(scenario(fmt::format(R"(
gaitlab: 1
robot:
  position: [0, 0, 0.15]
  orientation: [0, 0.3, 0]
  docks: [[0, 1, 1, 0, 0]]
  modules:
    name: rod
    bodies: {{rod: {{mass: 0.5, inertia: [0.0001, 0.002, 0.002, 0, 0, 0]}}}}
    faces:
      - {{id: 0, body: rod, gender: active, origin: [-0.1, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}}
      - {{id: 1, body: rod, gender: passive, origin: [0.1, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}}
    contacts: {{feet: [{{body: rod, point: [-0.1, 0, 0]}}, {{body: rod, point: [0.1, 0, 0]}}]}}
contact: {{on: feet}}
actuator: {{type: none}}
physics: {{engine: {}}}
duration: 0.3
trace: {{period: 2e-4, columns: [reaction.m1/dock.*]}}
)",
                                                               GetParam())));
  const DenseBending bending(record, 75);
  EXPECT_LT(bending.at_ticks, 0.8 * bending.dense) << "control ticks alone miss it";
  EXPECT_NEAR(bending.watched, bending.dense, 0.05 * bending.dense);
}

/// The rotor of a pendulum has the inertia of the rod, m l^2 / 3, and the motor has no torque. The gear passes on the torque
/// that turns the rotor, which is half of the weight's moment m g l/2 sin(q) and largest at the start, where q = 1.
TEST_P(LoadsOf, AGearThatTurnsItsRotor) {
  const Scenario s =
      shipped("pendulum.yaml",
              {"actuator={type: dc_motor, Kt: 0, gear: 100, rotor_inertia: 3.3333333333333335e-5, gear_torque_peak: 2}",
               "physics.engine=" + GetParam(), "duration=1"});
  const Recording record = run_with_loads(s);
  const double half = 0.5 * 9.81 * 0.5 * std::sin(1.0);
  EXPECT_NEAR(std::abs(load(record, 0, "gear.0.torque")), half, 1e-6);
  const std::optional<report::GearPeak> peak = report::gear_load(record, 0, 2);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->torque, half, 1e-6);
  EXPECT_EQ(peak->time, 0);
  EXPECT_EQ(peak->beyond, 0.0);
  const report::Verdict verdict = report::verdict(s, record, report::summarise(s, record, 0), report::overlaps(s, record));
  const report::Check& check = *std::ranges::find(verdict.checks, "gear_peak", &report::Check::id);
  EXPECT_EQ(check.status, report::CheckStatus::fail) << check.text;
  EXPECT_NEAR(check.value, half, 1e-6);
}

/// The torque of a motor that turns a heavy rotor at the start exceeds the rating, but that of its gear does not. No joint is
/// then named as the first beyond the rating. The rotor has 100 times the inertia of the rod, so that the gear passes on a
/// hundredth of the torque.
TEST_P(LoadsOf, AGearThatIsSparedByItsRotor) {
  const Scenario s = shipped(
      "pendulum.yaml", {"actuator={type: dc_motor, gear: 100, rotor_inertia: 3.3333333333333335e-3, gear_torque_peak: 0.3}",
                        "controller={type: pid, Kp: 1000}", "cpg={type: sine, amplitude: 0, offset: 1.5}",
                        "physics.engine=" + GetParam(), "duration=0.1", "physics.gravity=[0, 0, 0]"});
  const Recording record = run_with_loads(s);
  ASSERT_GT(record.joints[0].torque_peak, 0.3);
  const report::Verdict verdict = report::verdict(s, record, report::summarise(s, record, 0), report::overlaps(s, record));
  const report::Check& check = *std::ranges::find(verdict.checks, "gear_peak", &report::Check::id);
  EXPECT_EQ(check.status, report::CheckStatus::pass) << check.text;
  EXPECT_EQ(check.first_part, "");
  EXPECT_NEAR(check.value, record.joints[0].torque_peak / 101, 0.01 * check.value) << "I / (I + n^2 J) of the torque";
}

TEST(Loads, OfFeetAreThoseOfTheirContactElements) {
  Scenario s = shipped("hexapod.yaml", {"duration=0.6", "physics.engine=articulated", "trace.period=0.015"});
  s.trace.columns = {"contact.*"};
  const Recording record = run_with_loads(s);
  ASSERT_EQ(record.loads.rows(), record.trace.rows());
  const Trace& loads = record.loads;
  for (std::size_t row = 0; row < loads.rows(); ++row) {
    for (const char axis : {'x', 'y', 'z'}) {
      double feet = 0;
      double elements = 0;
      for (std::size_t c = 0; c < loads.columns.size(); ++c) {
        if (glob(std::string("foot.*.f") + axis, loads.columns[c].name)) feet += loads.at(row, c);
      }
      for (std::size_t c = 0; c < record.trace.columns.size(); ++c) {
        if (glob(std::string("contact.*.f") + axis, record.trace.columns[c].name)) elements += record.trace.at(row, c);
      }
      EXPECT_NEAR(feet, elements, 1e-5);  // float rounding errors of six forces of up to 40 N
    }
  }
}

TEST(Loads, ChangeNothingElseAndDependOnNoRowsAndNoOtherLane) {
  const auto walk = [](const char* period, const std::string& columns) {
    return shipped("caterpillar.yaml", {"duration=0.4", "physics.engine=articulated", std::string("trace.period=") + period,
                                        "trace.columns=" + columns});
  };
  const Scenario one = walk("0.005", "[joint.*]");
  const Recording with = run_with_loads(one);
  const Recording without = run(one);
  EXPECT_EQ(hash(with.trace), hash(without.trace));
  EXPECT_EQ(hash(with.rest), hash(without.rest));
  EXPECT_EQ(hash(with.ticks), hash(without.ticks));
  EXPECT_TRUE(without.loads.columns.empty());
  EXPECT_EQ(with.loads.rows(), with.ticks.rows());
  for (const char* const period : {"5e-4", "0.0137", "0.1"})
    EXPECT_EQ(hash(run_with_loads(walk(period, "[t, reaction.*]")).loads), hash(with.loads)) << period;
  std::vector<Scenario> lanes(4, one);
  for (std::size_t l = 1; l < lanes.size(); ++l) {
    lanes[l] =
        shipped("caterpillar.yaml", {"duration=0.2", "physics.engine=articulated", fmt::format("cpg.amplitude=0.{}", l)});
  }
  Simulation together(lanes, Loads::recorded);
  together.run();
  EXPECT_EQ(hash(together.take_recording(0).loads), hash(with.loads));
  EXPECT_EQ(hash(together.take_recording(2).loads), hash(run_with_loads(lanes[2]).loads));
}

/// With `contact.law: bullet` only loads of feet are recorded, because not all forces of Bullet's solver are known.
TEST(Loads, OfTheSolverAreOfFeetAlone) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=0.1", "physics.engine=bullet", "contact.law=bullet"});
  const Recording record = run_with_loads(s);
  EXPECT_EQ(record.loads.find("dock.1.tension"), record.loads.columns.size());
  double carried = 0;
  for (const Column& column : record.loads.columns) {
    if (glob("foot.*.fz", column.name)) carried += last_load(record, column.name);
  }
  EXPECT_GT(carried, 0);
}

TEST(Loads, LieInTheRunFolder) {
  const Folder folder;
  const Recording record = run_with_loads(shipped("caterpillar.yaml", {"duration=0.1", "physics.engine=articulated"}));
  ASSERT_TRUE(std::isnan(load(record, 0, "stability"))) << "it starts above the ground: this one is kept, too";
  write_recording(record, {"", 0, "", "done"}, "h5", folder.path());
  EXPECT_EQ(hash(read_recording(folder.path()).recording.loads), hash(record.loads));
}

TEST(Loads, AreLinearBetweenTicks) {
  Recording r;
  r.trace.columns = {{"t", "s", ""}};
  r.trace.values = {0, 0.5, 1, 1.75, 2};
  r.loads.columns = {{"t", "s", ""}, {"slip", "m", ""}};
  r.loads.values = {0, 10, 1, 20, 2, NAN};
  const Trace rows = report::loads_at_rows(r);
  ASSERT_EQ(rows.rows(), 5U);
  EXPECT_EQ(rows.at(1, 0), 0.5);
  EXPECT_EQ(rows.at(0, 1), 10);
  EXPECT_EQ(rows.at(1, 1), 15);
  EXPECT_EQ(rows.at(2, 1), 20) << "at a tick: no neighbour counts";
  EXPECT_TRUE(std::isnan(rows.at(3, 1)));
  halve_rows(r.loads);
  EXPECT_EQ(r.loads.rows(), 2U);
  EXPECT_EQ(r.loads.at(1, 0), 2);
  r.loads = {};
  EXPECT_EQ(report::loads_at_rows(r).rows(), 0U);
}

}  // namespace
}  // namespace gaitlab::test
