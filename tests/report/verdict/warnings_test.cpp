// Every warning appears for a scenario with its cause, and no warning appears for the shipped scenarios.
#include "report/verdict/warnings.h"

#include <cmath>
#include <tuple>

#include "core/scenario/sensor_section.h"
#include "report/analysis/summary.h"
#include "report/verdict/leg_sag.h"
#include "tests/labels.h"
#include "tests/report/verdict/messages.h"

namespace gaitlab::test {
namespace {

const Label kLongWarnings("RunWarnings.AreSilentOnShippedScenarios", "long");

using namespace report;

const std::vector<std::string> kShipped{
    "caterpillar.yaml", "caterpillar-equations.yaml", "hexapod.yaml",      "octopod.yaml", "pendulum.yaml",
    "rubble.yaml",      "paper-caterpillar.yaml",     "paper-hexapod.yaml"};

std::vector<Warning> of(const std::string& file, const std::vector<std::string>& sets) {
  return setup_warnings(shipped(file, sets));
}

/// Expects exactly one warning, of this severity and with this part of its text.
void expect_one(const std::vector<Warning>& found, bool severe, const std::string& part) {
  ASSERT_EQ(found.size(), 1U) << part;
  EXPECT_EQ(found[0].severe, severe);
  EXPECT_TRUE(contains(found[0].text, part)) << found[0].text;
}

TEST(SetupWarnings, AreSilentOnShippedScenarios) {
  for (const std::string& file : kShipped) {
    for (const Warning& doubt : of(file, {})) ADD_FAILURE() << file << ": " << doubt.text;
  }
}

/// Four legs whose feet are 0.1 m before or behind their hinges yield as the engine says, and the warning has a gain that holds
/// them.
TEST(SetupWarnings, LegsThatYield) {
  std::string bodies, hinges;
  for (const auto& [name, x, y] : {std::tuple("a", 0.2, 0.1), {"b", 0.2, -0.1}, {"c", -0.2, 0.1}, {"d", -0.2, -0.1}}) {
    bodies += fmt::format(
        "      {}: {{mass: 0.01, inertia: [1e-5, 1e-5, 1e-5, 0, 0, 0], shape: [{{sphere: 0.01, origin: [{}, 0, -0.1]}}]}}\n",
        name, x / 2);
    hinges += fmt::format(
        "      - {{name: at_{0}, parent: trunk, child: {0}, origin: [{1}, {2}, 0], axis: [0, 1, 0], range: [-1, 1]}}\n", name,
        x, y);
  }
  const std::string text =
      "gaitlab: 1\nrobot:\n  modules:\n    gaitlab_module: 1\n    name: table\n    bodies:\n"
      "      trunk: {mass: 2, inertia: [0.02, 0.03, 0.03, 0, 0, 0], shape: [{box: [0.4, 0.2, 0.05]}]}\n" +
      bodies + "    hinges:\n" + hinges +
      "    contacts: {all: shapes}\n"
      "    actuator: {type: servo, voltage: 6, stall_torque: 3, no_load_speed: 10, load_friction: 0, dry_friction: 0, "
      "viscous_friction: 0}\n"
      "    controller: {type: pid, Kp: 20, Kd: 0}\n"
      "contact: {on: all}\nground: {friction: 0}\nphysics: {engine: articulated}\nduration: 3\n"
      "cpg: {type: sine, frequency: 0.5, amplitude: 0}\n";
  const Scenario s = scenario(text);
  const std::optional<LegSag> sag = leg_sag(s, plugin_info(s), std::vector<double>(4, 0.0));
  ASSERT_TRUE(sag);
  constexpr double kStiffness = 20 * 3.0 / 6;  // N m/rad
  const double load = s.robot->mass * 9.81 / 4;
  EXPECT_NEAR(sag->angle, load * 0.1 / kStiffness, 1e-12);
  double yields = 0;  // the lever grows while it yields
  for (int i = 0; i < 50; ++i) yields = load / kStiffness * 0.1 * (std::cos(yields) + std::sin(yields));
  EXPECT_NEAR(std::abs(run(s).joint(0, "angle").back()), yields, 1e-3 * yields) << "the robot still settles";
  const auto warned = [&](const std::vector<std::string>& sets) {
    for (const Warning& one : setup_warnings(scenario(text, sets))) {
      if (contains(one.text, "the legs yield")) return one.text;
    }
    return std::string();
  };
  EXPECT_EQ(
      warned({}),
      "the legs yield by up to 0.05 rad under the weight of the robot, first m0/at_a, and by more while feet are lifted; "
      "expected at most 0.03 rad, so that feet clear the ground: Kp 150 V/rad with controller.period 0.002 s holds them to "
      "0.0067 rad");
  EXPECT_EQ(warned({"controller.Kp=150", "controller.period=0.002"}), "");
  EXPECT_EQ(warned({"robot.base=fixed"}), "");
}

TEST(SetupWarnings, TellASlipOfUnits) {
  // Kt is 3.95 N m/A instead of 3.95 mN m/A, which differs from Ks by a factor of 1000.
  expect_one(of("caterpillar.yaml", {"actuator.Kt=3.95"}), true, "differ by a factor of 1e+03");
  expect_one(of("caterpillar.yaml", {"actuator.Ks=0.0053"}), true, "differ by a factor of 1.34");
  EXPECT_TRUE(of("caterpillar.yaml", {"actuator.Ks=0.005"}).empty()) << "1.27: of a data sheet";
}

TEST(SetupWarnings, TellAMotorWithoutTorque) {
  for (const char* const key : {"Kt", "u_max", "i_max"}) {
    const std::vector<Warning> found = of("caterpillar.yaml", {std::string("actuator.") + key + "=0"});
    expect_one(found, true, std::string("m0/active makes no torque: ") + key + " is 0");
  }
}

TEST(SetupWarnings, TellAMotorThatMakesEnergy) {
  expect_one(of("caterpillar.yaml", {"actuator.Kt=0.0045", "actuator.efficiency=1"}), true, "makes energy");
  EXPECT_TRUE(of("caterpillar.yaml", {"actuator.efficiency=1"}).empty()) << "an ideal motor";
  EXPECT_TRUE(of("caterpillar.yaml", {"actuator.Kt=0.0045"}).empty()) << "efficiency 0.7: 0.00315 < 0.00395";
}

/// The largest gain without overshoot, (Kp + D) period / (Ks gear) = 1, is at Kp = 0.00395 * 594 / 0.015 - 8.9 = 147.5 V/rad,
/// with D = 2 * 0.6 * 10 / (2 * 0.6 + 10 * 0.015); the largest that settles is at 304.0.
TEST(SetupWarnings, TellALoopThatCannotSettle) {
  EXPECT_TRUE(of("caterpillar.yaml", {"controller.Kp=147"}).empty());
  expect_one(
      of("caterpillar.yaml", {"controller.Kp=148"}), false,
      "the joint overshoots (gain 1.003 per command, at most 1); take Kp: 140 or less, or controller.period: 0.014 or less");
  expect_one(of("caterpillar.yaml", {"controller.Kp=303"}), false, "overshoots (gain 1.994 per command, at most 1)");
  expect_one(of("caterpillar.yaml", {"controller.Kp=305"}), true,
             "may not settle (gain 2.007 per command, at most 2); take Kp: 300 or less, or controller.period: 0.014 or less");
  expect_one(of("paper-caterpillar.yaml", {"controller.period=0.015"}), true,
             "cannot settle (gain 10.09 per command, at most 2); take Kp: 300 or less, or controller.period: 0.0029 or less");
  // The bound is 2/3 for an angle that is one tick old and a heavy load, and 2/5 for two ticks.
  expect_one(
      of("caterpillar.yaml", {"sensors={type: encoder, delay: 0.015}"}), false,
      "for commands every 0.015 s, angles up to 0.015 s old: the joint overshoots (gain 0.6393 per command, at most 0.333); "
      "take Kp: 52 or less");
  expect_one(of("caterpillar.yaml", {"sensors={type: encoder, delay: 0.03}"}), true,
             "the joint may not settle (gain 0.6393 per command, at most 0.4); take Kp: 62 or less");
  EXPECT_TRUE(of("caterpillar.yaml", {"controller.Kp=303", "controller.period=0.005"}).empty());
  expect_one(of("caterpillar.yaml", {"controller.Kp={default: 100, m3/active: 400}"}), true, "of joint m3/active");
}

/// The rule for Kp does not apply to a motor without back-EMF, because nothing limits its speed.
TEST(SetupWarnings, DoNotJudgeAMotorWithoutBackEmf) {
  EXPECT_TRUE(of("caterpillar.yaml", {"actuator.Ks=0", "controller.Kp=1000"}).empty());
}

/// The rule for Kp does not apply to a loop with a derivative gain, which changes the bound. The derivative contributes
/// 20 * 3000 / (20 + 3000 * 0.015) = 923 V/rad in the first tick.
TEST(SetupWarnings, DoNotJudgeALoopWithADerivativeGain) {
  EXPECT_TRUE(of("caterpillar.yaml", {"controller.Kp=400", "controller.Kd=20", "controller.N=3000"}).empty());
}

/// One step of the encoder is 0.00153 * 600 N m/rad = 0.917 N m of 1.97; 10 % are 0.000328 rad, or Kp 336.
TEST(SetupWarnings, TellAnEncoderWhoseStepsDecideTheTorques) {
  expect_one(of("paper-caterpillar.yaml", {"sensors={type: encoder, resolution: 0.00153}"}), true,
             "one step of the encoder of joint m0/active, 0.00153 rad, commands 0.917 N m, 46.6 % of the 1.97 N m that its "
             "motor has at "
             "rest: such steps dominate the torques; take resolution: 0.00032 or less, or Kp: 330 or less");
  EXPECT_TRUE(of("paper-caterpillar.yaml", {"sensors={type: encoder, resolution: 0.00032}"}).empty());
  EXPECT_TRUE(of("caterpillar.yaml", {"sensors={type: encoder, resolution: 0.00511}"}).empty())
      << "10 bit on 300 degrees: 9.9 %";
  expect_one(of("caterpillar.yaml", {"sensors={type: encoder, resolution: 0.0061, joints: m3/active}"}), true,
             "joint m3/active");
}

TEST(SetupWarnings, TellDegrees) {
  expect_one(of("caterpillar.yaml", {"cpg.phase_lag=70"}), true, "is it in degrees (1.222 rad)?");
  expect_one(of("caterpillar.yaml", {"robot.orientation=[0, 0, 90]"}), true, "is it in degrees (1.571 rad)?");
  EXPECT_TRUE(of("caterpillar.yaml", {"cpg.phase_lag=-6.3", "robot.orientation=[0, 0, 6.3]"}).empty());
}

TEST(SetupWarnings, TellARobotBesideItsField) {
  const std::string field =
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]%s}\nduration: 0.1\n"
      "ground: {type: heightfield, heightfield: {values: [[0, 0], [0, 0]], origin: [5, 5, 0], spacing: 0.5}}\n";
  const auto with = [&](const std::string& place) {
    std::string text = field;
    return text.replace(text.find("%s"), 2, place);
  };
  expect_one(setup_warnings(scenario(with(""))), true, "beside the heightfield");
  EXPECT_TRUE(setup_warnings(scenario(with(", position: [5.2, 5.2]"))).empty());
}

std::string warnings_of(const Scenario& s) {
  const Recording r = run(s);
  std::string text;
  for (const std::string& doubt : messages(s, r, About::gait)) text += doubt + "\n";
  return text;
}

TEST(RunWarnings, AreSilentOnShippedScenarios) {
  for (const std::string& file : kShipped)
    EXPECT_EQ(warnings_of(shipped(file, {"duration=4", "physics.engine=articulated"})), "") << file;
}

/// A robot without joints runs with the default columns and without a warning on the energy balance of motors.
TEST(RunWarnings, AreSilentOnAStone) {
  const Scenario stone = scenario(
      "gaitlab: 1\nrobot: {base: fixed, modules: {name: rigid, bodies: {block: {mass: 1, com: [0, 0, 0], inertia: [1, 1, 1, 0, "
      "0, 0]}}}}\n"
      "contact: {on: none}\nduration: 0.1\n");
  EXPECT_EQ(warnings_of(stone), "");
  EXPECT_EQ(messages(stone, run(stone)), std::vector<std::string>{});
}

TEST(RunWarnings, TellANegativeCostOfTransportHoweverSmall) {
  const Scenario s = shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=1"});
  Recording r = run(s);
  double drawn = 0;
  for (const JointStatistics& joint : r.joints) drawn += joint.electrical;
  ASSERT_GT(drawn, 0);
  ASSERT_GT(travelled(r).distance, 0);
  r.joints[0].electrical -= drawn + 1e-9;
  r.ledger.electrical = -1e-9;  // much less than the energy that lifts the robot by 1 mm
  EXPECT_LT(summarise(s, r, 1).cost_electrical, 0);
  std::string text;
  for (const std::string& doubt : messages(s, r)) text += doubt + "\n";
  EXPECT_TRUE(contains(text, "so that the cost of transport is negative")) << text;
}

TEST(RunWarnings, TellASetPointThatJumps) {
  const std::vector<std::string> sine{"duration=0.3", "physics.engine=articulated", "cpg.type=sine"};
  const auto with = [&](const std::string& set) {
    std::vector<std::string> sets = sine;
    sets.push_back(set);
    return warnings_of(shipped("caterpillar.yaml", sets));
  };
  EXPECT_TRUE(contains(with("cpg.amplitude=0.6"), "0.598 rad from its angle at t = 0"));
  EXPECT_FALSE(contains(with("cpg.model.ramp=1"), "at t = 0"));
  EXPECT_TRUE(contains(with("cpg.offset=0.3"), "at t = 0"));
}

/// A CPG with `ramp` has no jump of the set points at the start, because the ramp also applies to the offset.
TEST(RunWarnings, ARampIsOfTheOffset) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=0.1", "physics.engine=articulated", "cpg.type=sine",
                                                  "cpg.offset=0.3", "cpg.model.ramp=1"});
  EXPECT_FALSE(contains(warnings_of(s), "at t = 0"));
}

TEST(RunWarnings, TellACpgThatMovesNothing) {
  const auto of = [](const std::string& set) {
    const Scenario s = shipped("caterpillar.yaml", {"duration=12", "physics.engine=articulated", set});
    std::string text;
    for (const std::string& doubt : messages(s, run(s))) text += doubt + "\n";
    return text;
  };
  EXPECT_TRUE(contains(of("cpg.type=keyframes"), "cpg keyframes moves no joint"));
  EXPECT_TRUE(contains(of("cpg.amplitude=0"), "moves no joint"));
}

TEST(RunWarnings, TellJointsBeyondTheirRange) {
  const std::string text =
      warnings_of(shipped("caterpillar.yaml", {"duration=3", "physics.engine=articulated", "cpg.amplitude=1.9"}));
  EXPECT_TRUE(contains(text, "leave the range of the hinge; worst ")) << text;
}

TEST(RunWarnings, TellARobotThatLeavesItsField) {
  const Scenario s = scenario(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]], position: [0, 0, 0.5]}\nduration: 0.3\n"
      "initial: {base_velocity: [3, 0, 0]}\nphysics: {engine: articulated}\nactuator: {type: none}\n"
      "ground: {type: heightfield, heightfield: {values: [[0, 0], [0, 0]], origin: [-0.5, -0.5, 0], spacing: 1}}\n");
  EXPECT_TRUE(contains(warnings_of(s), "leaves its heightfield at t = 0.1"));
}

/// The program warns of bodies that pass through one another. Modules in a row coil up: hinges at 1.2 rad close a ring after
/// 2 pi / 1.2 = 5.2 blocks.
TEST(RunWarnings, TellBodiesThatPassThroughOneAnother) {
  const char* const coil =
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0]], position: [0, 0, 1]}\n"
      "initial: {angles: {default: %s}}\nduration: 0.02\nphysics: {engine: articulated, gravity: [0, 0, 0]}\n"
      "actuator: {type: none}\nground: {type: none}\n";
  const auto with = [&](const std::string& angle, const std::string& more) {
    std::string text = coil;
    return warnings_of(scenario(text.replace(text.find("%s"), 2, angle) + more));
  };
  const std::string text = with("1.2", "");
  EXPECT_TRUE(contains(text, "of bodies pass")) << text;
  EXPECT_EQ(with("0.6", ""), "");
}

/// The program warns of bodies that pass through the ground. Two modules stand on their end faces and lift or lower their
/// middle; the only feet are at the ends.
TEST(RunWarnings, TellBodiesThatGoThroughTheGround) {
  const auto with = [&](const std::string& on) {
    return warnings_of(
        scenario("gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 1\nphysics: {engine: articulated}\n"
                 "cpg: {type: sine, amplitude: 0.5, phase_lag: 1.2, frequency: 0.5, model: {ramp: 0.5}}\ncontact: {on: " +
                 on + "}\n"));
  };
  EXPECT_TRUE(contains(with("feet"), "mm into the ground; set contact.on: all")) << with("feet");
  EXPECT_EQ(with("all"), "");
}

}  // namespace
}  // namespace gaitlab::test
