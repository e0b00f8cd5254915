// Tests of engine `articulated`: comparison with engine `bullet`, orders of the integrators, motors at their limits.
#include <cmath>

#include "tests/labels.h"
#include "tests/program/random_scenario.h"
#include "tests/program/torques.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

// Whole walks of both engines.
const Label kWalksOfTwo("Of/WalkOfTwoEngines.*", "long;unsanitized");

const Label kLongArticulated(
    "Engines.TraceTheSameModelUnderTheSameMethod:Engines.TraceRandomRobotsUnderTheSameMethod:Articulated."
    "IsRightWhereManyMotorsAreLimited",
    "long");

Acceleration accelerate(const std::string& engine, const PlantSettings& settings, const RobotState& state, In tau,
                        std::span<const BodyWrench> wrenches) {
  Acceleration out;
  out.joints.resize(tau.size());
  catalog().engine(engine)->make(settings)->accelerate(0, state, tau, wrenches, out);
  return out;
}

TEST(Engines, AccelerateAlikeAtRandomStates) {
  RandomRobots random(31);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    PlantSettings settings;
    settings.robot = std::make_shared<const Robot>(random.robot());
    settings.base = std::array{Base::floating, Base::fixed, Base::planar}[static_cast<std::size_t>(i % 3)];
    settings.gravity = random.vector(10);
    settings.ground.shape = NoGround{};
    const RobotState state = random.state(*settings.robot, settings.base);
    std::vector<double> tau;
    for (std::size_t j = 0; j < settings.robot->joints.size(); ++j) tau.push_back(random.uniform(-1, 1));
    const std::vector<BodyWrench> wrenches{
        {random.below(settings.robot->bodies.size()), random.vector(1), random.vector(5), random.vector(1)}};
    const Acceleration a = accelerate("articulated", settings, state, tau, wrenches);
    const Acceleration b = accelerate("bullet", settings, state, tau, wrenches);
    double largest = std::max(b.linear.norm(), b.angular.norm());
    double error = std::max((a.linear - b.linear).norm(), (a.angular - b.angular).norm());
    for (std::size_t j = 0; j < tau.size(); ++j) {
      largest = std::max(largest, std::abs(b.joints[j]));
      error = std::max(error, std::abs(a.joints[j] - b.joints[j]));
    }
    worst = std::max(worst, error / largest);
  }
  validate_below({"property.engines.accelerations",
                  "articulated against bullet: accelerations over the largest one, 100 random assemblies and wrenches",
                  "two articulated-body algorithms, in other frames", ""},
                 worst, 1e-9, "required by the issue; rounding times the condition of M, 1e-16 * 1e5");
}

/// Largest difference in any column of two traces, relative to the column's largest magnitude. The first row is omitted: there
/// the depth of contacts is a rounding error, and a contact law with an exponent below 1 amplifies it.
double difference(const Trace& a, const Trace& b) {
  double worst = 0;
  for (std::size_t c = 1; c < a.columns.size(); ++c) {
    if (a.columns[c].name.starts_with("torque_error.")) continue;  // these columns are small differences of large numbers
    double most = 0;
    double apart = 0;
    for (std::size_t row = 1; row < a.rows(); ++row) {
      most = std::max(most, std::abs(a.at(row, c)));
      apart = std::max(apart, std::abs(a.at(row, c) - b.at(row, c)));
    }
    if (most > 1e-6) worst = std::max(worst, apart / most);  // smaller columns contain only rounding errors
  }
  return worst;
}

// With the same explicit method, both engines give the same trace up to rounding. The robots have all forces: hinges in their
// stops, points and spheres that stick, slide and bounce with exponents other than 1, rotors, directional gears, limited
// currents. The test takes 6 s of CPU time, mostly to factorise the mass matrix with rotors in bullet, in 6000 steps of three
// robots.
TEST(Engines, TraceTheSameModelUnderTheSameMethod) {
  const auto thrown = [](const std::string& engine, const std::string& base, const std::string& velocity) {
    return run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/caterpillar-8.dat, base: {}}}
initial:
  angles: {{m1/passive: 1.56, m4/active: -1.565}}
  speeds: {{default: 0.5, m1/passive: 6, m4/active: -5}}
  base_velocity: {}
physics: {{engine: {}, integrator: rk4, step: 1e-5}}
contact: {{on: all, exponent: 1.5, stiffness: 2e5, damping: 2e3, damping_exponent: 0.5}}
actuator: {{rotor_inertia: 1e-9, efficiency_model: directional}}
cpg: {{type: sine, model: {{ramp: 0.01}}}}
duration: 0.06
trace: {{period: 5e-3, columns: ["*"]}}
)",
                                    base, velocity, engine)));
  };
  for (const auto& [base, velocity] :
       {std::pair("floating", "[0.3, 0.2, -0.5]"), std::pair("planar", "[0.3, 0, -0.5]"), std::pair("fixed", "[0, 0, 0]")}) {
    const Recording a = thrown("articulated", base, velocity);
    const Recording b = thrown("bullet", base, velocity);
    double stops = 0;
    double touching = 0;
    const Table table(a.trace);
    for (std::size_t row = 0; row < a.trace.rows(); ++row) {
      stops = std::max(stops, std::abs(table.at(row, "joint.3.stop_torque")));
      for (std::size_t c = 0; c < 96; ++c) touching = std::max(touching, table.at(row, fmt::format("contact.{}.fn", c)));
    }
    EXPECT_GT(stops, 0.1) << base;
    EXPECT_GT(touching, 0.1) << base;
    validate_below({"property.engines.traces",
                    "articulated against bullet, rk4: worst column of all, thrown robots that hit stops and ground, 60 ms",
                    "another algorithm, the same model", ""},
                   difference(a.trace, b.trace), 1e-9,
                   "depths of 1e-17 m are rounding at first and the law takes their root: 1e-8 of the first forces, fading");
    EXPECT_NEAR(a.worst.rate, b.worst.rate, 1e-6 * b.worst.rate);
    EXPECT_EQ(a.worst.source, b.worst.source);
  }
}

// With the same explicit method, both engines give the same trace of random robots up to rounding. The modules are numbered in
// any order, motors work at or below their limits, and grounds are soft or stiff, rough or smooth. The test takes 5 s of CPU
// time, mostly in bullet.
TEST(Engines, TraceRandomRobotsUnderTheSameMethod) {
  RandomRobots random(71);
  double worst = 0;
  double rubbed = 0;
  double stopped = 0;
  double limited = 0;  // sum over the joints of the share of time at a limit
  for (std::size_t i = 0; i < 40; ++i) {
    const Base base = std::array{Base::floating, Base::floating, Base::planar, Base::fixed}[i % 4];
    Scenario s = random_run(random, base, 40, random.uniform(0.05, 0.2));
    s.physics.integrator = s.physics.engine->integrator("rk4");
    const Recording b = run(s);
    s.physics.engine = catalog().engine("articulated");
    s.physics.integrator = s.physics.engine->integrator("rk4");
    const Recording a = run(s);
    worst = std::max(worst, difference(a.trace, b.trace));
    rubbed += a.ledger.friction;
    stopped += std::abs(a.ledger.stops);
    for (const JointStatistics& joint : a.joints) limited += joint.saturated_current;
  }
  EXPECT_GT(rubbed, 0.1) << "J";
  EXPECT_GT(stopped, 0.1) << "J";
  EXPECT_GT(limited, 3) << "joints, all the time";
  EXPECT_LT(worst, 1e-9) << "rounding times the condition of M, 1e-16 * 1e5, which 400 steps multiply by up to a hundred";
}

TEST(Engines, JudgeAnExplicitStepAlike) {
  const auto standing = [](const std::string& engine) {
    const Scenario s = shipped("hexapod.yaml", {"physics.engine=" + engine, "physics.integrator=rk4", "physics.step=2.5e-5"});
    return Simulation({&s, 1}).standing();
  };
  EXPECT_NEAR(standing("articulated").rate, standing("bullet").rate, 1e-9 * standing("bullet").rate);
  EXPECT_EQ(standing("articulated").index, standing("bullet").index);
}

/// Final angles of two rods of 1 kg and 1 m with motors, whose damping is about as fast as the swing of the rods, rad.
std::array<double, 2> driven_rods(const std::string& engine, const std::string& integrator, double step) {
  const Recording record = run(scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 0]
  modules:
    name: two-rods
    bodies:
      support: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      upper: {{mass: 1, com: [0, 0, -0.5], inertia: [0.0833, 0.0833, 1e-3, 0, 0, 0]}}
      lower: {{mass: 1, com: [0, 0, -0.5], inertia: [0.0833, 0.0833, 1e-3, 0, 0, 0]}}
    hinges:
      - {{name: upper, parent: support, child: upper, axis: [0, 1, 0], range: [-100, 100]}}
      - {{name: lower, parent: upper, child: lower, origin: [0, 0, -1], axis: [0, 1, 0], range: [-100, 100]}}
initial: {{angles: [1, 0.5], speeds: [0.3, -2]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{i_max: 1000, u_max: 1000}}
controller: {{type: hold, command: [2, -3], period: 0.1}}
physics: {{engine: {}, integrator: {}, step: {}}}
duration: 1
trace: {{period: 0.1, columns: [joint.*]}}
)",
                                                    engine, integrator, step)));
  const Table table(record.trace);
  return {table.at(record.trace.rows() - 1, "joint.0.angle"), table.at(record.trace.rows() - 1, "joint.1.angle")};
}

double order(const std::string& integrator, double step, const std::array<double, 2>& exact) {
  const auto error = [&](double h) {
    const auto end = driven_rods("articulated", integrator, h);
    return std::hypot(end[0] - exact[0], end[1] - exact[1]);
  };
  return std::log2(error(step) / error(step / 2));
}

TEST(Articulated, HasTheOrdersItIsSaidToHave) {
  const auto exact = driven_rods("bullet", "rk4", 2.5e-4);  // order 4, error about 1e-12
  const std::string source = "docs/equations.md, 7; error against bullet, rk4 at 0.25 ms";
  const auto row = [&](const std::string& integrator, const std::string& steps) {
    return Row{"order.articulated." + integrator, "two rods with motors, 1 s, " + steps + ": log2 of the errors' ratio", source,
               ""};
  };
  const std::string reason = "the next order is smaller by the step times the rates, 10/s";
  validate(row("implicit", "1 and 0.5 ms"), order("implicit", 1e-3, exact), 1, 0.1, reason);
  validate(row("extrapolated", "2 and 1 ms"), order("extrapolated", 2e-3, exact), 2, 0.2, reason);
  validate(row("rk4", "10 and 5 ms"), order("rk4", 1e-2, exact), 4, 0.4, reason);
}

/// Step of 0.3 rad of the last joint's set point in a chain, which at first requires the full current.
class SetPointStep : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(At, SetPointStep, testing::Values(5e-5, 1e-4, 2.5e-4, 5e-4, 1e-3, 2.5e-3));

TEST_P(SetPointStep, DoesNotChatterAtTheCurrentLimit) {
  for (const char* integrator : {"adaptive", "implicit", "extrapolated"}) {
    const Recording record = run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/caterpillar-8.dat, base: fixed, on_ground: false, position: [0, 0, 1]}}
ground: {{type: none}}
contact: {{on: none}}
physics: {{engine: articulated, integrator: {}, step: {}}}
actuator: {{i_max: 0.3}}
cpg: {{type: table, model: {{repeat: false, file: "t, m7/passive\n0, 0.3\n1, 0.3\n"}}}}
duration: 0.3
trace: {{period: {}, columns: [joint.*]}}
)",
                                                      integrator, GetParam(), GetParam())));
    const Table table(record.trace);
    double fastest = 0;
    int limited = 0;
    int flips = 0;
    double before = 0;
    for (std::size_t row = 1; row < record.trace.rows(); ++row) {
      fastest = std::max(fastest, std::abs(table.at(row, "joint.15.speed")));
      const double current = table.at(row, "joint.15.current");
      // A change of the current's sign counts as chatter only between two control ticks, where the command is constant.
      if (std::abs(std::remainder(table.at(row - 1, "t"), 0.015)) < 1e-9) before = 0;
      if (table.at(row, "joint.15.saturation") != 2) continue;
      ++limited;
      flips += current * before < 0 ? 1 : 0;
      before = current;
    }
    // The extrapolation from one and two steps of a stiff decay overshoots by at most 0.036 of the jump.
    const double beyond = integrator == std::string("extrapolated") ? 0.036 : 0.02;
    EXPECT_LT(fastest, (1 + beyond) * 7.4 / (0.00395 * 594)) << integrator;
    if (integrator == std::string("implicit")) {
      EXPECT_LE(record.joints[15].torque_peak, 0.7 * 0.00395 * 0.3 * 594 * (1 + 1e-12));
    }
    EXPECT_EQ(flips, 0) << integrator << " " << limited;
    EXPECT_NEAR(table.at(record.trace.rows() - 1, "joint.15.angle"), 0.3, 0.03) << integrator;
  }
}

// Walks of 6 s in both engines. Each takes about 8 s of CPU time in engine bullet at 12.5 us. All other tests with long walks
// use only engine articulated and rely on this comparison.
class WalkOfTwoEngines : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, WalkOfTwoEngines, testing::Values("caterpillar", "hexapod", "rubble"));

TEST_P(WalkOfTwoEngines, IsOneWalk) {
  constexpr double kFrom = 4;  // start of the comparison, s; at this time every joint performs the gait
  const auto with = [](std::vector<std::string> sets) {
    sets.insert(sets.end(), {"duration=6", "trace.columns=[joint.*]"});
    return run(shipped(GetParam() + ".yaml", sets));
  };
  const Recording bullet = with({"physics.engine=bullet", "physics.step=1.25e-5"});
  const Recording ours = with({"physics.engine=articulated", "physics.integrator=extrapolated", "physics.step=1e-4"});
  const double worst = torques_off(ours, bullet, kFrom);
  const std::string what = "articulated, extrapolated at 0.1 ms, against bullet at 12.5 us: ";
  validate_below({"property.engines." + GetParam(), what + "RMS of any joint's torque over its peak, 4 to 6 s",
                  "another engine, another method", ""},
                 worst, 0.005, "required by the issue: 0.5 %");
  const auto travel = [](const Recording& r) { return Vec3(r.travel().x(), r.travel().y(), 0); };
  validate_below(
      {"property.engines." + GetParam() + "_travel", what + "displacement in 6 s", "another engine, another method", ""},
      (travel(bullet) - travel(ours)).norm() / travel(bullet).norm(), 0.003, "required by the issue: 0.3 %");
  EXPECT_LT(std::abs(ours.ledger.residual()), 0.005 * ours.ledger.electrical);
}

// Torques are accurate in a chain that hangs from its first module and swings, although most motors are at a limit in every
// half period.
TEST(Articulated, IsRightWhereManyMotorsAreLimited) {
  const auto swung = [](const std::string& physics) {
    return run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/caterpillar-8.dat, base: fixed, position: [0, 0, 1]}}
ground: {{type: none}}
contact: {{on: none}}
physics: {{gravity: [0, 0, -0.5], {}}}
cpg: {{type: phase_oscillator, frequency: 0.5, amplitude: 0.6, phase_lag: 1.2}}
duration: 2
trace: {{columns: [joint.*]}}
)",
                                    physics)));
  };
  const Recording bullet = swung("engine: bullet, step: 1e-5");
  const Recording ours = swung("engine: articulated, integrator: extrapolated, step: 1e-4");
  double limited = 0;
  for (const JointStatistics& joint : bullet.joints) limited = std::max(limited, joint.saturated_current);
  EXPECT_GT(limited, 0.05) << "share of the time";
  EXPECT_LT(torques_off(ours, bullet), 0.005) << "as on the ground; with the limit's corners extrapolated it is 0.014";
}

TEST(Articulated, IsThereForTheProgram) {
  const Folder folder;
  const std::string engine = " --set physics.engine=articulated";
  EXPECT_NE(gaitlab("list engine", folder / "").out.find("  articulated "), std::string::npos);
  EXPECT_NE(
      gaitlab("explain engine articulated", folder / "").out.find("adaptive, implicit, extrapolated, rk4 (default adaptive)"),
      std::string::npos);
  const Result check = gaitlab("check '" + kScenarios + "hexapod.yaml'" + engine, folder / "");
  EXPECT_NE(check.out.find("engine articulated (adaptive), step auto (at most 0.005 s), accuracy 1 %\n"), std::string::npos)
      << check.out;
  for (const std::string name : {"caterpillar", "hexapod", "octopod", "pendulum"}) {
    const std::string arguments =
        fmt::format("run '{}{}.yaml'{} --set duration=0.1 --quiet --out {}", kScenarios, name, engine, name);
    EXPECT_EQ(gaitlab(arguments, folder / "").code, 0) << name;
    const Result again = gaitlab("rerun --verify " + name, folder / "");
    EXPECT_EQ(again.code, 0) << again.out << again.err;
  }
  const Result too_long =
      gaitlab("run '" + kScenarios + "caterpillar.yaml'" + engine + " --set physics.integrator=rk4 --set physics.step=2e-4",
              folder / "");
  EXPECT_EQ(too_long.code, 2);
  EXPECT_NE(too_long.err.find("step 0.0002 s is too long"), std::string::npos) << too_long.err;
}

}  // namespace
}  // namespace gaitlab::test
