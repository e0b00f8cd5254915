// Module types in scenarios: faces without gender, motors and controllers by module type and hinge, hinges without stops.
#include <cmath>

#include "core/dynamics/dock_load.h"
#include "core/dynamics/inverse_dynamics.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/resolved.h"
#include "tests/messages.h"
#include "tests/program/engines.h"

namespace gaitlab::test {
namespace {

/// Module file of a 60 mm cube: two halves with a hinge, face 0 at the rear and face 1 at the front. `faces` and `rest` are
/// YAML.
std::string cube(const std::string& name, const std::string& faces, const std::string& rest,
                 const std::string& hinge = "range: [-1.5, 1.5]") {
  return fmt::format(R"(
    {0}:
      gaitlab_module: 1
      name: {0}
      bodies:
        tail: {{mass: 0.09, com: [-0.015, 0, 0], inertia: [5e-05, 3e-05, 3e-05, 0, 0, 0]}}
        head: {{mass: 0.05, com: [0.015, 0, 0], inertia: [3e-05, 2e-05, 2e-05, 0, 0, 0]}}
      hinges: [{{name: hinge, parent: tail, child: head, axis: [0, 1, 0], {3}}}]
      faces:
{1}
      contacts: {{feet: [{{body: head, point: [0.03, 0, -0.03]}}, {{body: tail, point: [-0.03, 0, -0.03]}}]}}
{2})",
                     name, faces, rest, hinge);
}

std::string faces(const std::string& more = "") {
  return fmt::format(R"(
        - {{id: 0, body: tail, gender: none, origin: [-0.03, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]{0}}}
        - {{id: 1, body: head, gender: none, origin: [0.03, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]{0}}}
)",
                     more);
}
constexpr const char* kMotor = "      actuator: {type: dc_motor, i_max: 0.5, source: \"chosen: test\"}\n";

std::string robot(const std::string& types, const std::string& modules, const std::string& docks,
                  const std::string& rest = "") {
  return fmt::format(R"(
gaitlab: 1
robot:
  types:{}
  modules: {}
  docks: {}
physics: {{engine: articulated}}
cpg: {{type: phase_oscillator, frequency: 0.5, amplitude: 0.5}}
duration: 0.3
{})",
                     types, modules, docks, rest);
}

std::string error_of(const std::string& text, const std::vector<std::string>& sets = {}) {
  return message_of([&] { scenario(text, sets); });
}

TEST(ModuleTypes, ARingIsRefused) {
  const std::string ring =
      error_of(robot(cube("cube", faces(), kMotor), "cube", "[[0, 1, 1, 0, 0], [0, 2, 1, 1, 0], [0, 0, 1, 2, 0]]"));
  EXPECT_TRUE(contains(ring, "closes a ring")) << ring;
  EXPECT_TRUE(contains(ring, "docks must form a tree")) << ring;
}

TEST(ModuleTypes, OnlyLikeConnectorsDock) {
  const std::string a = cube("a", faces(", connector: hook, turns: [0, 2]"), kMotor);
  const std::string b = cube("b", faces(", connector: roficom"), kMotor);
  const std::string c = cube("c", faces(), kMotor);
  const std::string other = error_of(robot(a + b, "{0: a, 1: b}", "[[0, 1, 1, 0, 0]]"));
  EXPECT_TRUE(
      contains(other,
               "face 0 of module 1 has connector 'roficom', but face 1 of module 0 has 'hook'; only faces with the same "
               "connector dock"))
      << other;
  const std::string none = error_of(robot(a + c, "{0: a, 1: c}", "[[0, 1, 1, 0, 0]]"));
  EXPECT_TRUE(contains(
      none,
      "face 0 of module 1 has connector none, but face 1 of module 0 has 'hook'; only faces with the same connector dock"))
      << none;
  const std::string turn = error_of(robot(a, "a", "[[0, 1, 1, 0, 1]]"));
  EXPECT_TRUE(contains(turn, "orientation 1 is not one of the turns of face 0 (a): 0, 2")) << turn;
  EXPECT_EQ(error_of(robot(a, "a", "[[0, 1, 1, 0, 2]]")), kNoError);
  EXPECT_EQ(error_of(robot(c, "c", "[[0, 1, 1, 0, 3]]")), kNoError);
  const std::string mixed = error_of(robot(c, "{0: c, 1: mtran}", "[[1, 1, 1, 0, 0]]"));
  EXPECT_TRUE(contains(mixed,
                       "wrong gender: face 1 of module 1 has gender active, but face 1 of module 0 has gender none; active "
                       "docks on passive, and none on none, so module 1 has no face that fits"))
      << mixed;
}

/// Torque of each joint at rest under the largest command, N m.
std::vector<double> stall(const Scenario& s) {
  const auto actuator = make_actuator(s.actuator, info(*s.robot));
  const std::size_t n = s.robot->joints.size();
  std::vector<double> command(actuator->command_limit().begin(), actuator->command_limit().end()), rest(n), torque(n), slope(n);
  actuator->effort(command, rest, torque, slope);
  return torque;
}

constexpr const char* kSmallMotor =  // motor of 0.245 N m and 8.73 rad/s at 4.8 V
    "      actuator: {type: dc_motor, R: 7.53828336475, Kt: 0.00183346494442, Ks: 0.00183346494442, gear: 300, efficiency: "
    "0.7, "
    "u_max: 4.8, i_max: 0.636749743641, source: \"SG92R\"}\n"
    "      controller: {type: pid, Kp: 26, Kd: 0}\n";
const std::string kGendered = R"(
        - {id: 0, body: tail, gender: active, origin: [-0.03, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}
        - {id: 1, body: head, gender: passive, origin: [0.03, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}
)";

TEST(ModuleTypes, EveryJointHasTheMotorAndTheGainsOfItsType) {
  const std::string text = robot(cube("small", kGendered, kSmallMotor), "{0: mtran, 1: small}", "[[0, 1, 4, 0, 0]]");
  const Scenario s = scenario(text);
  const std::vector<double> torques = stall(s);
  EXPECT_NEAR(torques[0], 1.97, 0.005) << "mtran: eta Kt i_max n";
  EXPECT_NEAR(torques[1], 1.97, 0.005);
  EXPECT_NEAR(torques[2], 0.245, 0.0005) << "2.5 kgf cm";
  const std::string full = resolved(s);
  EXPECT_TRUE(contains(full, "Kp: [100, 100, 26]")) << full;
  EXPECT_TRUE(contains(full, "Kd: [0.6, 0.6, 0]")) << full;
  EXPECT_TRUE(contains(full, "gear: [594, 594, 300]")) << full;
  EXPECT_TRUE(contains(full, "efficiency: 0.7\n")) << "one value for all stays one: " << full;
  // The resolved text is sufficient to repeat the run.
  EXPECT_EQ(resolved(scenario(full)), full);
  EXPECT_EQ(run(scenario(full)).trace.values, run(s).trace.values);
  // Values of the scenario override those of the module types.
  EXPECT_TRUE(contains(resolved(scenario(text, {"controller.Kp=50", "actuator.i_max=0.3"})), "Kp: 50"));
  EXPECT_NEAR(stall(scenario(text, {"actuator.i_max=0.3"}))[2], 0.7 * 0.00183346494442 * 0.3 * 300, 1e-9);
}

TEST(ModuleTypes, DifferentKindsOfMotorsAreAQuestion) {
  const std::string torque = "      actuator: {type: torque, limit: 1}\n";
  const std::string text = error_of(robot(cube("small", kGendered, torque), "{0: mtran, 1: small}", "[[0, 1, 4, 0, 0]]"));
  EXPECT_TRUE(contains(text, "the module types have different actuators; choose one: add actuator: {type: ...}")) << text;
  const std::string none = error_of(robot(cube("small", kGendered, ""), "{0: mtran, 1: small}", "[[0, 1, 4, 0, 0]]"));
  EXPECT_TRUE(contains(none, "some of the module types with a motor state none; choose one")) << none;
  const std::string hold = "      actuator: {type: dc_motor}\n      controller: {type: hold}\n";
  const std::string controllers = error_of(robot(cube("small", kGendered, hold), "{0: mtran, 1: small}", "[[0, 1, 4, 0, 0]]"));
  EXPECT_TRUE(contains(controllers, "the module types have different controllers; choose one")) << controllers;
  const std::string models = "      actuator: {type: dc_motor, efficiency_model: directional}\n";
  const std::string one = error_of(robot(cube("small", kGendered, models), "{0: mtran, 1: small}", "[[0, 1, 4, 0, 0]]"));
  EXPECT_TRUE(contains(one, "efficiency_model must be equal for all joints of a robot, but differs between its hinges")) << one;
}

TEST(ModuleTypes, AHingeHasAMotorOfItsOwn) {
  const std::string own = "range: [-1.5, 1.5], actuator: {i_max: 0.2}, controller: {Kp: 7}";
  const Scenario s = scenario(robot(cube("cube", faces(), kMotor, own), "cube", "[]"));
  EXPECT_NEAR(stall(s)[0], 0.7 * 0.00395 * 0.2 * 594, 1e-9);
  EXPECT_TRUE(contains(resolved(s), "Kp: 7"));
  const std::string wrong =
      error_of(robot(cube("cube", faces(), kMotor, "range: [-1, 1], actuator: {imax: 0.2}"), "cube", "[]"));
  EXPECT_TRUE(contains(wrong, "unknown key 'imax'; did you mean 'i_max'?")) << wrong;
  const std::string type =
      error_of(robot(cube("cube", faces(), kMotor, "range: [-1, 1], actuator: {type: torque}"), "cube", "[]"));
  EXPECT_TRUE(contains(type, "unknown key 'type'")) << type;
}

TEST(ModuleTypes, AHingeThatTurnsFreelyHasNoEnd) {
  const std::string wheel = cube("cube", faces(), kMotor, "range: free");
  const std::string text = robot(wheel, "cube", "[]");
  const Scenario s = scenario(text, {"cpg={type: equations, model: {output: \"2*t\"}}", "duration=6", "contact.on=none",
                                     "ground.type=none", "robot.base=fixed"});
  for (const std::string& engine : catalog().engines()) {
    Scenario one = s;
    one.physics.engine = catalog().engine(engine);
    one.physics.integrator = &one.physics.engine->fixed();
    one.physics.adaptive_step = false;
    one.physics.step = engine == "articulated" ? one.physics.engine->step : one.physics.engine->choose_step(one);
    one.duration = engine == "articulated" ? 6 : 0.6;
    const Recording r = run(one);
    EXPECT_NEAR(end(r, "joint.0.angle"), 2 * one.duration, 0.2)
        << engine << ": 2 rad/s, behind by what the motor's back-EMF takes";
    EXPECT_EQ(r.joints[0].range_share, 0) << engine;
    EXPECT_EQ(r.ledger.stops, 0) << engine;
    EXPECT_EQ(end(r, "joint.0.stop_torque"), 0) << engine;
  }
  const std::string ranged = error_of(robot(cube("cube", faces(), kMotor), "cube", "[]"), {"cpg.amplitude=30"});
  EXPECT_TRUE(contains(ranged,
                       "amplitude of joint m0/hinge is 30 rad; expected -3.2 to 3.2 rad for a hinge with a range; 30 "
                       "degrees are 0.5236 rad"))
      << ranged;
}

TEST(ModuleTypes, ARobotWithoutJointsNeedsNoColumns) {
  const Scenario stone = scenario(R"(
gaitlab: 1
robot: {modules: {gaitlab_module: 1, name: stone, bodies: {stone: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}}, position: [0, 0, 1]}
physics: {engine: articulated}
contact: {on: none}
duration: 0.1
)");
  EXPECT_GT(run(stone).trace.rows(), 10U);
}

// In a horizontal cantilever of three M-TRAN modules, a dock that carries j modules has the shear j m g and the bending moment
// j^2 m g L / 2 with L = 0.13 m.
TEST(ModuleTypes, ACantileverLoadsItsDocks) {
  const Scenario s = scenario(R"(
gaitlab: 1
robot: {base: fixed, position: [0, 0, 1], docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0]]}
ground: {type: none}
contact: {on: none}
physics: {engine: articulated}
actuator: {type: none}
duration: 1
)");
  Kinematics k(*s.robot);
  RobotState state;
  state.position = Vec3(0, 0, 1);
  state.q.assign(6, 0.0);
  state.qd.assign(6, 0.0);
  k.update(*s.robot, state);
  InverseDynamics inverse(*s.robot);
  Acceleration none;
  none.linear = none.angular = Vec3::Zero();
  none.joints.assign(6, 0.0);
  inverse.update(k, none, Vec3(0, 0, -9.81), {});
  for (const double j : {1.0, 2.0}) {
    const DockLoad load = dock_load(inverse.dock(static_cast<std::size_t>(3 - j)), Vec3::UnitX());
    EXPECT_NEAR(load.shear, j * 0.4 * 9.81, 1e-12) << "3.924 and 7.848 N";
    EXPECT_NEAR(load.bending, j * j * 0.4 * 9.81 * 0.13 / 2, 1e-12) << "0.25506 and 1.02024 N m";
    EXPECT_NEAR(load.tension, 0, 1e-12);
    EXPECT_NEAR(load.torsion, 0, 1e-12);
  }
}

}  // namespace
}  // namespace gaitlab::test
