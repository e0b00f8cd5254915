// Tests of the command `gaitlab dynamics`, of the accelerations of all engines against core/dynamics, and of reaction columns.
#include <Eigen/Cholesky>
#include <nlohmann/json.hpp>

#include "core/dynamics/mass_matrix.h"
#include "tests/program/engines.h"
#include "tests/random_robots.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

constexpr const char* kScenario = R"(
gaitlab: 1
robot: {{modules: mtran, docks: [[1, 1, 4, 0, 1], [0, 2, 5, 1, 2]], base: {}, position: [0.1, 0.2, 0.7]}}
initial: {{angles: [0.1, -0.2, 0.3, 0.4, -0.5, 0.6], speeds: [1, 2, -3, 0.5, -1, 2]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
duration: 1
)";

/// Calls `gaitlab dynamics` in a folder with a scenario `s.yaml` and the shipped module types.
class DynamicsCommand : public testing::Test {
 protected:
  DynamicsCommand() {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    base("floating");
  }
  void base(const std::string& kind) { folder_.write("s.yaml", fmt::format(kScenario, kind)); }

  Result call(const std::string& state, const std::string& options = {}) {
    folder_.write("state.json", state);
    return gaitlab("dynamics s.yaml --state state.json " + options, folder_ / "");
  }
  nlohmann::json answer(const nlohmann::json& state, const std::string& options = {}) {
    const Result result = call(state.dump(), options);
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  }

  Folder folder_;
};

Eigen::VectorXd vector(const nlohmann::json& json) {
  const auto numbers = json.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

const nlohmann::json kState = {{"q", {0.3, -0.4, 0.5, 0.6, -0.7, 0.2}},
                               {"qd", {1, -2, 3, -1, 2, 0.5}},
                               {"tau", {0.1, 0.2, -0.3, 0.4, 0.5, -0.6}},
                               {"wrenches", {{{"body", "m2/link"}, {"force", {1, 2, 3}}, {"torque", {0.1, 0, -0.1}}}}}};
// Tolerance for forward dynamics by Bullet, which uses principal axes, and inverse dynamics by core/dynamics: some hundred
// rounding errors, amplified by the condition of M (about 1e4).
constexpr double kRound = 1e-10;

TEST_F(DynamicsCommand, InverseOfForwardIsTheIdentityOnEveryBase) {
  for (const std::string kind : {"floating", "fixed", "planar"}) {
    base(kind);
    nlohmann::json state = kState;
    if (kind == "floating") state["base"] = {{"velocity", {1, 2, 3}}, {"angular_velocity", {2, -1, 1}}};
    if (kind == "planar") state["base"] = {{"velocity", {1, 0, 3}}, {"angular_velocity", {0, -1, 0}}};
    const nlohmann::json out = answer(state);
    state["qdd"] = out["qdd"];
    for (const char* key : {"acceleration", "angular_acceleration"}) state["base"][key] = out["base"][key];
    const nlohmann::json back = answer(state, "--inverse");
    EXPECT_LT((vector(back["tau"]) - vector(state["tau"])).norm(), kRound) << kind;
    if (kind == "floating") {
      EXPECT_LT(vector(back["base_wrench"]["force"]).norm() + vector(back["base_wrench"]["torque"]).norm(), kRound);
    }
    // M [base acceleration; qdd] + bias = [0; tau]
    const Eigen::VectorXd linear = vector(out["base"]["acceleration"]);
    const Eigen::VectorXd angular = vector(out["base"]["angular_acceleration"]);
    Eigen::VectorXd a(out["bias"].size());
    if (kind == "floating") a << linear, angular, vector(out["qdd"]);
    if (kind == "planar") a << linear[0], linear[2], angular[1], vector(out["qdd"]);
    if (kind == "fixed") a << vector(out["qdd"]);
    Eigen::VectorXd sum = vector(out["bias"]);
    for (Eigen::Index i = 0; i < sum.size(); ++i) sum[i] += vector(out["mass_matrix"][static_cast<std::size_t>(i)]).dot(a);
    sum.tail(6) -= vector(state["tau"]);
    EXPECT_LT(sum.norm(), kRound) << kind;
  }
}

TEST_F(DynamicsCommand, ReactionsAreNamedByJointsAndDocks) {
  base("fixed");
  const nlohmann::json out = answer({{"qd", 0}}, "--inverse");
  // The modules of 0.4 kg are at rest, so that a dock carries the weight of all modules that hang from it.
  EXPECT_NEAR(vector(out["reactions"]["m1/dock"]["force"])[2], 0.8 * 9.81, 1e-12);
  EXPECT_NEAR(vector(out["reactions"]["m2/dock"]["force"])[2], 0.4 * 9.81, 1e-12);
  EXPECT_NEAR(vector(out["base_wrench"]["force"])[2], 1.2 * 9.81, 1e-12);
  EXPECT_EQ(out["reactions"].size(), 8U);
  EXPECT_TRUE(out["reactions"].contains("m2/passive"));
}

TEST_F(DynamicsCommand, WhatIsMissingIsAsTheScenarioStarts) {
  const nlohmann::json start = {{"q", {0.1, -0.2, 0.3, 0.4, -0.5, 0.6}},
                                {"qd", {1, 2, -3, 0.5, -1, 2}},
                                {"tau", 0},
                                {"base", {{"position", {0.1, 0.2, 0.7}}, {"quaternion", {1, 0, 0, 0}}}}};
  EXPECT_EQ(call("{}").out, call(start.dump()).out);
}

TEST_F(DynamicsCommand, ErrorsHaveTheirPlaceAndOfferAName) {
  const auto expect = [&](const std::string& state, const std::string& text) {
    const Result result = call(state);
    EXPECT_EQ(result.code, 2) << state;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
  };
  expect("{\n \"q\": [1, 2,\n}", "state.json:3:1: error: not valid JSON: ");
  expect("{q: 1}", "state.json:1:2: error: not valid JSON: ");
  expect("", "state.json:1:1: error: not valid JSON: ");
  expect("[1]", "state.json:1:1: error: found a list; expected a map");
  expect("{\"q\": [1, 2]}", "state.json:1:7: error: q has 2 numbers; expected one for each of the robot's 6 joints");
  expect("{\n\t\"taux\": 0}", "state.json:2:2: error: unknown key 'taux'; did you mean 'tau'?");
  expect("{\"q\":{\"m1/activ\":1}}", "state.json:1:7: error: no joint 'm1/activ'; did you mean 'm1/active'?");
  expect("{\"qd\": [0, 0, 0, \"1\", 0, 0]}", "state.json:1:18: error: qd[3] is \"1\" in quotes");
  expect("{\"tau\": 1e999}", "state.json:1:9: error: tau is ");
  expect("{\"q\": 0, \"q\": 0}", "state.json:1:10: error: duplicate key 'q'");
  expect("{\"base\": {\"velocity\": [1, 2]}}", "state.json:1:23: error: velocity has 2 numbers");
  expect("{\"base\": {\"quaternion\": [1, 1, 0, 0]}}", "state.json:1:25: error: quaternion has the length 1.414");
  expect("{\"base\": 3}", "state.json:1:10: error: base is 3; expected a map");
  expect("{\"wrenches\": [{\"body\": \"m1/lnk\"}]}", "state.json:1:24: error: no body 'm1/lnk'; did you mean 'm1/link'?");
  expect("{\"wrenches\": [{\"force\": [1, 0, 0]}]}", "state.json:1:15: error: missing key 'body'");
  base("fixed");
  expect("{\"base\": {\"velocity\": [1, 2, 3]}}", "state.json:1:23: error: a fixed base does not move");
  const Result missing = gaitlab("dynamics s.yaml --state none.json", folder_ / "");
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find("none.json: error: "), std::string::npos) << missing.err;
}

/// Accelerations of a robot by one evaluation of an engine.
Acceleration accelerate(const std::string& engine, const std::shared_ptr<const Robot>& robot, Base base,
                        const RobotState& state, const std::vector<double>& tau, const std::vector<BodyWrench>& wrenches,
                        const Vec3& gravity) {
  PlantSettings settings;
  settings.robot = robot;
  settings.base = base;
  settings.gravity = gravity;
  settings.ground.shape = NoGround{};
  const std::unique_ptr<Plant> plant = catalog().engine(engine)->make(settings);
  Acceleration out;
  out.joints.resize(tau.size());
  plant->accelerate(0, state, tau, wrenches, out);
  return out;
}

class Dynamics : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, Dynamics, engines(), engine_name);

TEST_P(Dynamics, AgreeWithTheInverseDynamicsAtRandomStates) {
  RandomRobots random(11);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const auto robot = std::make_shared<const Robot>(random.robot());
    const Base base = std::array{Base::floating, Base::fixed, Base::planar}[static_cast<std::size_t>(i % 3)];
    const RobotState state = random.state(*robot, base);
    std::vector<double> tau;
    for (std::size_t j = 0; j < robot->joints.size(); ++j) tau.push_back(random.uniform(-1, 1));
    const std::vector<BodyWrench> wrenches{
        {random.below(robot->bodies.size()), random.vector(1), random.vector(5), random.vector(1)}};
    const Vec3 gravity = random.vector(10);
    const Acceleration a = accelerate(GetParam(), robot, base, state, tau, wrenches, gravity);
    Kinematics k(*robot);
    k.update(*robot, state);
    InverseDynamics dynamics(*robot);
    dynamics.update(k, a, gravity, wrenches);
    Eigen::VectorXd residual = generalised_force(dynamics, base);
    residual.tail(static_cast<Eigen::Index>(tau.size())) -=
        Eigen::Map<const Eigen::VectorXd>(tau.data(), static_cast<Eigen::Index>(tau.size()));
    MassMatrix mass(*robot, base);
    mass.update(k);
    // The residual of the equations of motion is converted to an acceleration and divided by the largest acceleration.
    double largest = std::max(a.linear.norm(), a.angular.norm());
    for (const double x : a.joints) largest = std::max(largest, std::abs(x));
    worst = std::max(worst, mass.matrix().llt().solve(residual).norm() / largest);
  }
  validate_below(
      {"property.inverse-of-forward", "M^-1 (RNEA(ABA(tau)) - tau) over the largest acceleration, 100 random assemblies",
       "recursive Newton-Euler, independent of the engines' articulated-body algorithms", ""},
      worst, 1e-9, "required by the issue; rounding times the condition of M, 1e-16 * 1e5");
}

/// The reaction columns of two modules that hang at rest from a fixed base are the weights below each place.
TEST(ReactionColumns, HangingChainCarriesTheWeightBelow) {
  const Scenario hanging = scenario(R"(
gaitlab: 1
robot: {modules: mtran, docks: [[1, 1, 4, 0, 0]], base: fixed, position: [0, 0, 1], orientation: [0, 1.5707963267948966, 0]}
ground: {type: none}
physics: {step: 2.5e-5}
duration: 0.03
trace: {period: 0.015, columns: [reaction.*, joint.*.speed]}
)");
  const Recording record = run(hanging);
  const Table table(record.trace);
  const auto z = [&](const std::string& name) { return table.at(2, "reaction." + name + ".fz"); };
  // The chain hangs straight down, so that only rounding errors move it. A module consists of 0.16 kg (active block), 0.08 kg
  // (link) and 0.16 kg (passive block).
  EXPECT_NEAR(z("base"), 0.8 * 9.81, 1e-9);
  EXPECT_NEAR(z("0"), 0.64 * 9.81, 1e-9);
  EXPECT_NEAR(z("1"), 0.56 * 9.81, 1e-9);
  EXPECT_NEAR(z("m1/dock"), 0.4 * 9.81, 1e-9);
  EXPECT_NEAR(z("2"), 0.24 * 9.81, 1e-9);
  EXPECT_NEAR(z("3"), 0.16 * 9.81, 1e-9);
  EXPECT_NEAR(table.at(2, "reaction.m1/dock.fx"), 0, 1e-9);
}

/// In a walking robot, the reaction of a hinge along its axis is the torque of motor and stop. The reaction of the free base is
/// 0.
TEST(ReactionColumns, CarryMotorAndStopTorquesAndNothingHoldsTheBase) {
  Scenario walking = shipped("caterpillar.yaml", {"duration=0.2", "trace.period=0.02", "controller.period=0.02"});
  walking.trace.columns = {"*"};
  const Recording record = run(walking);
  const Table table(record.trace);
  double touching = 0;
  for (std::size_t row = 0; row < record.trace.rows(); ++row) {
    const auto vec = [&](const std::string& name) {
      return Vec3(table.at(row, name + "x"), table.at(row, name + "y"), table.at(row, name + "z"));
    };
    // The tolerance is for rounding errors of Bullet, about 1e-10 of the contact forces of 10 N.
    EXPECT_LT(vec("reaction.base.f").norm() + vec("reaction.base.m").norm(), 1e-8);
    for (std::size_t m = 0; m < walking.robot->modules.size(); ++m) {
      const Series load = record.series(fmt::format("load.{}", m));
      if (!load.empty()) touching += load[row];
    }
    RobotState state = record.state(*walking.robot, row);
    Kinematics k(*walking.robot);
    k.update(*walking.robot, state);
    for (std::size_t j = 0; j < walking.robot->joints.size(); ++j) {
      const std::size_t link = walking.robot->joints[j].link;
      const std::string joint = fmt::format("joint.{}.", j);
      EXPECT_NEAR(vec(fmt::format("reaction.{}.m", j)).dot(k.R[link] * walking.robot->links[link].axis),
                  table.at(row, joint + "torque") + table.at(row, joint + "stop_torque"), 1e-8);
    }
  }
  EXPECT_GT(touching, 0);
}

/// The part n^2 J qdd of a motor's torque accelerates the rotor. The reactions of the hinge contain only the rest of the
/// torque.
TEST(ReactionColumns, BalanceWithRotors) {
  // With one row per step, qdd follows from the speeds of two rows, because semi_implicit adds h qdd to the speeds. Rows
  // between which the command changes are skipped.
  Scenario walking = shipped("caterpillar.yaml", {"physics.integrator=semi_implicit", "duration=0.045", "trace.period=2.5e-5",
                                                  "controller.period=0.02", "actuator.rotor_inertia=1e-8"});
  ASSERT_EQ(walking.physics.step, 2.5e-5);
  walking.trace.columns = {"reaction.base.*", "reaction.3.*", "joint.3.*"};
  const double rotor = 594 * 594 * 1e-8;  // n^2 J
  const Recording record = run(walking);
  const Table table(record.trace);
  for (std::size_t row = 0; row < record.trace.rows(); ++row) {
    for (const char* axis : {"fx", "fy", "fz", "mx", "my", "mz"}) {
      EXPECT_NEAR(table.at(row, std::string("reaction.base.") + axis), 0, 1e-8);
    }
  }
  double largest = 0;
  for (std::size_t row = 0; row + 1 < record.trace.rows(); ++row) {
    if (row % 800 == 0) continue;
    Kinematics k(*walking.robot);
    k.update(*walking.robot, record.state(*walking.robot, row));
    const std::size_t link = walking.robot->joints[3].link;
    const Vec3 moment(table.at(row, "reaction.3.mx"), table.at(row, "reaction.3.my"), table.at(row, "reaction.3.mz"));
    const double qdd = (table.at(row + 1, "joint.3.speed") - table.at(row, "joint.3.speed")) / 2.5e-5;
    // A rounding error of 1e-16 rad/s in 25 us is 1e-11 rad/s^2. The rest of the tolerance is for rounding errors of Bullet.
    EXPECT_NEAR(moment.dot(k.R[link] * walking.robot->links[link].axis),
                table.at(row, "joint.3.torque") + table.at(row, "joint.3.stop_torque") - rotor * qdd, 1e-8)
        << row;
    largest = std::max(largest, std::abs(rotor * qdd));
  }
  EXPECT_GT(largest, 1e-3);  // the torque of the rotor is large enough for a test, N m
}

/// Further columns of the trace do not change the run.
TEST(ReactionColumns, LeaveTheRunAsItIs) {
  Scenario plain = shipped("caterpillar.yaml", {"duration=0.06"});
  Scenario asked = plain;
  asked.trace.columns.emplace_back("reaction.*");
  const Recording a = run(plain);
  const Recording b = run(asked);
  for (const Trace* table : {&a.trace, &a.rest}) {
    for (const Column& column : table->columns)
      EXPECT_EQ(a.series(column.name).values(), b.series(column.name).values()) << column.name;
  }
}

}  // namespace
}  // namespace gaitlab::test
