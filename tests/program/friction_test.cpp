// Tests of the friction of driven joints, in every engine, against closed forms for a rod of 1 kg and 1 m, whose inertia about
// its hinge is 1/3 kg m^2.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/simulation/batch.h"
#include "tests/labels.h"
#include "tests/program/bits.h"
#include "tests/program/engines.h"
#include "tests/program/rod.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

/// A rod on a motor. Without a gain, a motor of type torque gives only friction.
struct DrivenRod {
  std::string engine, motor;
  std::string controller = "{type: pid, unit: N m, Kp: 0, Kd: 0}";
  std::string physics = "accuracy: 1e-3", gravity = "[0, 0, -9.81]";
  double angle = 0, speed = 0, duration = 4, row = 0.005;
  std::string more = {};
  [[nodiscard]] Scenario read(const std::vector<std::string>& sets = {}) const {
    return scenario(rod() + fmt::format(R"(
initial: {{angles: {}, speeds: {}}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {}
controller: {}
physics: {{engine: {}, gravity: {}, {}}}
duration: {}
trace: {{period: {}, columns: [joint.*, energy.*, steps.*]}}
{}
)",
                                        angle, speed, motor, controller, engine, gravity, physics, duration, row, more),
                    sets);
  }
};

std::size_t first_at_rest(const Recording& record) {
  const Table table(record.trace);
  std::size_t row = 0;
  while (row < record.trace.rows() && table.at(row, "joint.0.speed") != 0) ++row;
  return row;
}

class Friction : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, Friction, engines(), engine_name);

/// I w' = -F - c w ends at a known time and angle, and then nothing moves any more.
TEST_P(Friction, StopsARotorAtTheTimeOfTheClosedForm) {
  constexpr double kDry = 0.3;
  constexpr double kViscous = 0.2;
  constexpr double kSpeed = 2;
  DrivenRod rod{GetParam(), fmt::format("{{type: torque, dry_friction: {}, viscous_friction: {}}}", kDry, kViscous)};
  rod.gravity = "[0, 0, 0]";
  rod.speed = kSpeed;
  const Recording record = run(rod.read());
  const Table table(record.trace);
  const double tau = kRodInertia / kViscous;
  const double time = tau * std::log1p(kViscous * kSpeed / kDry);
  const double angle = tau * kSpeed - kDry / kViscous * time;
  const std::size_t rest = first_at_rest(record);
  ASSERT_LT(rest, record.trace.rows());
  const double left = kRodInertia * table.at(rest - 1, "joint.0.speed") / kDry;  // s, to a relative error of 0.7 % of 5 ms
  validate({"closed.friction.time." + GetParam(), GetParam() + ", accuracy 1e-3: rotor under dry and viscous friction, stop",
            "I / c ln(1 + c w / F)", "s"},
           table.at(rest - 1, "t") + left, time, 1e-4 * time, "required by the issue: 1e-4");
  validate({"closed.friction.angle." + GetParam(), "the same, angle", "I w / c - F t / c", "rad"}, end(record, "joint.0.angle"),
           angle, 1e-4 * angle, "required by the issue: 1e-4");
  for (std::size_t row = rest; row < record.trace.rows(); ++row) {
    EXPECT_EQ(table.at(row, "joint.0.speed"), 0);
    EXPECT_EQ(table.at(row, "joint.0.torque"), 0) << "nothing to hold";
  }
  EXPECT_NEAR(record.ledger.dry, kRodInertia / 2 * kSpeed * kSpeed, 1e-3 * kRodInertia / 2 * kSpeed * kSpeed);
  EXPECT_EQ(record.joints[0].dry, record.ledger.dry);
}

/// A half swing loses F (|q1| + |q2|) of the pendulum's energy; it rests where friction holds the weight.
TEST_P(Friction, StopsAPendulumExactly) {
  constexpr double kDry = 0.3;
  DrivenRod rod{GetParam(), fmt::format("{{type: torque, dry_friction: {}}}", kDry)};
  rod.angle = 1;
  rod.duration = 10;
  const Recording record = run(rod.read());
  const Table table(record.trace);
  std::vector<double> turns;
  double before = 0;  // last speed other than 0
  for (std::size_t row = 1; row < record.trace.rows(); ++row) {
    if (table.at(row - 1, "joint.0.speed") != 0) before = table.at(row - 1, "joint.0.speed");
    if (!(table.at(row, "joint.0.speed") * before < 0)) continue;
    // The speed is linear near the turn on either side of it, with accelerations that differ by friction.
    const double q = table.at(row - 1, "joint.0.angle");
    const double w = table.at(row - 1, "joint.0.speed");
    const double a = (-kRodWeight * std::sin(q) - std::copysign(kDry, w)) / kRodInertia;
    turns.push_back(q - w * w / (2 * a));
  }
  ASSERT_EQ(turns.size(), 7U);
  double last = 1;
  double largest = 0;
  for (const double turn : turns) {
    double next = last;  // (m g l / 2) (cos q2 - cos q1) = F (|q1| + |q2|)
    for (int i = 0; i < 60; ++i) next = std::acos(std::cos(last) + kDry / kRodWeight * (last + next));
    largest = std::max(largest, std::abs(std::abs(turn) - next));
    last = next;
  }
  validate_below({"closed.friction.swing." + GetParam(),
                  GetParam() + ", accuracy 1e-3: pendulum of 4.905 N m under 0.3 N m, largest error of seven amplitudes",
                  "balance of energy", "rad"},
                 largest, 2e-4, "1e-3 of the torque is 1e-3 of the friction's work on a swing of 0.1 rad");
  const double q = end(record, "joint.0.angle");
  EXPECT_LT(std::abs(kRodWeight * std::sin(q)), kDry);
  EXPECT_EQ(end(record, "joint.0.speed"), 0);
  EXPECT_NEAR(end(record, "joint.0.torque"), kRodWeight * std::sin(q), 1e-12) << "holds the weight, no more and no less";
  EXPECT_EQ(end(record, "joint.0.friction"), end(record, "joint.0.torque"));
  EXPECT_LT(std::abs(record.ledger.residual()), 1e-3 * record.ledger.dry);
}

/// A torque that rises slowly moves the joint when it exceeds the dry friction.
TEST_P(Friction, BreaksAwayAtTheDryFriction) {
  constexpr double kDry = 0.3;
  DrivenRod rod{GetParam(), fmt::format("{{type: torque, dry_friction: {}}}", kDry)};
  rod.gravity = "[0, 0, 0]";
  rod.controller = "{type: pid, unit: N m, Kp: 1, Kd: 0, period: 0.001}";
  rod.more = "cpg: {type: equations, model: {states: {x: 0.1}, output: x}}";  // 0.1 N m/s
  rod.row = 0.001;
  const Recording record = run(rod.read());
  const Table table(record.trace);
  std::size_t row = 0;
  while (row < record.trace.rows() && table.at(row, "joint.0.speed") == 0) ++row;
  ASSERT_LT(row, record.trace.rows());
  EXPECT_EQ(table.at(row - 1, "joint.0.angle"), 0);
  EXPECT_NEAR(table.at(row - 1, "joint.0.friction"), -table.at(row - 1, "joint.0.setpoint"), 1e-12) << "holds all of it";
  EXPECT_NEAR(0.1 * table.at(row - 1, "t"), kDry, 1e-3 * kDry) << "a control period is 1e-4 N m";
}

/// A rotor that turns back has the speed of the closed form, whenever in a step it passes rest.
TEST_P(Friction, TurnsBackAtTheTimeOfTheClosedForm) {
  constexpr double kRotor = 1e-3;  // kg m^2
  constexpr double kSlope = 0.34 / 7;
  constexpr double kMotor = -0.17;  // N m at rest, half the supply
  constexpr double kDry = 0.06;
  constexpr double kStep = 0.005;
  const auto exact = [&](double speed) {
    const double before = (kMotor - kDry) / kSlope;
    const double after = (kMotor + kDry) / kSlope;
    const double turn = kRotor / kSlope * std::log1p(-speed / before);
    return turn < kStep ? after * -std::expm1(-kSlope / kRotor * (kStep - turn))
                        : before + (speed - before) * std::exp(-kSlope / kRotor * kStep);
  };
  double largest = 0;
  for (double speed = 0.05; speed < 1.2; speed += 0.025) {
    const Recording record = run(scenario(rotor(kRotor) + fmt::format(R"(
initial: {{speeds: {}}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: servo, voltage: 6, stall_torque: 0.34, no_load_speed: 7, load_friction: 0, dry_friction: {}, viscous_friction: 0, rotor_inertia: 0}}
controller: {{type: hold, command: -3}}
physics: {{engine: {}, accuracy: 1e-3, gravity: [0, 0, 0], estimate: off}}
duration: {}
trace: {{period: {}, columns: [joint.*]}}
)",
                                                                      speed, kDry, GetParam(), kStep, kStep)));
    largest = std::max(largest, std::abs(end(record, "joint.0.speed") - exact(speed)));
  }
  // An accuracy of 1e-3 of 0.34 N m is 7e-3 rad/s; an adaptive step doubles this in a second test, and again in a quiet motion.
  EXPECT_LT(largest, 0.03);
}

/// A weight that friction can hold stays where it is, for any time; a heavier one does not.
TEST_P(Friction, HoldsAnArmWithoutCreep) {
  DrivenRod rod{GetParam(), "{type: dc_motor, dry_friction: 1.5}"};
  rod.controller = "{type: pid, Kp: 5, Kd: 0}";
  rod.angle = 0.3;  // 1.4496 N m
  rod.physics = "accuracy: 0.01";
  rod.duration = 60;
  const Recording held = run(rod.read());
  EXPECT_EQ(end(held, "joint.0.angle"), 0.3);
  EXPECT_EQ(held.joints[0].speed_peak, 0);
  EXPECT_NEAR(end(held, "joint.0.torque"), kRodWeight * std::sin(0.3), 1e-12);
  rod.angle = 0.32;  // 1.543 N m
  rod.duration = 1;
  EXPECT_LT(end(run(rod.read()), "joint.0.angle"), 0.3199) << "sinks until the motor helps";
}

/// A motor whose circuit is open has friction left.
TEST_P(Friction, RemainsWithoutACircuit) {
  DrivenRod rod{GetParam(), "{type: dc_motor, dry_friction: 0.3}"};
  rod.controller = "{type: pid}";
  rod.angle = 1;
  rod.duration = 12;
  rod.more = "at: [{t: 0, fault: {joint: \"*\", kind: open}}]";
  const Recording record = run(rod.read());
  EXPECT_EQ(end(record, "joint.0.speed"), 0);
  EXPECT_EQ(record.ledger.electrical, 0);
  EXPECT_GT(record.ledger.dry, 1);
}

/// Explicit methods have no jump: the rod moves as with the exact law, and creeps where it should rest.
TEST_P(Friction, CreepsUnderExplicitMethods) {
  DrivenRod rod{GetParam(), "{type: torque, dry_friction: 0.3, viscous_friction: 0.1}"};
  rod.angle = 1;
  rod.duration = 1.2;
  const double exact = end(run(rod.read()), "joint.0.angle");
  rod.physics = "integrator: rk4, step: 1e-4";
  const Recording smooth = run(rod.read());
  EXPECT_NEAR(end(smooth, "joint.0.angle"), exact, 0.01);  // near its turns the law of the rk4 run is weaker
  EXPECT_LT(std::abs(smooth.ledger.residual()), 1e-2 * smooth.ledger.dry);
}

/// A joint that creeps loses as much as its weight gives.
TEST_P(Friction, TheLedgerHasTheWorkOfACreep) {
  DrivenRod rod{GetParam(), "{type: torque, dry_friction: 2}"};
  rod.angle = 0.35;  // 1.68 N m
  rod.physics = "integrator: rk4, step: 1e-4";
  rod.duration = 1;
  const Recording record = run(rod.read());
  EXPECT_LT(end(record, "joint.0.angle"), 0.3) << "it creeps";
  EXPECT_GT(record.ledger.dry, 0.05);
  // Order 4 at h lambda of 6e-3; works are of the speeds at the starts of steps, to h over the time of the creep.
  EXPECT_LT(std::abs(record.ledger.residual()), 1e-3 * record.ledger.dry);
}

/// The gear's loss helps to hold and hinders to move: with E from the motor, the joint rests between eta E - dry and E / eta +
/// dry.
TEST_P(Friction, BreaksAwayAtTheBoundsOfTheGear) {
  constexpr double kLoad = 0.25;  // eta = 0.6
  constexpr double kDry = 0.1;
  DrivenRod rod{GetParam(),
                "{type: servo, voltage: 1, stall_torque: 3, no_load_speed: 5, load_friction: 0.25, dry_friction: 0.1, "
                "viscous_friction: 0, rotor_inertia: 0}"};
  rod.controller = "{type: pid, Kp: 1, Kd: 0, period: 0.001}";
  rod.row = 0.001;
  rod.angle = 0.1;  // 0.4897 N m of weight, which the motor holds up
  const double weight = kRodWeight * std::sin(rod.angle);
  const double eta = (1 - kLoad) / (1 + kLoad);
  const auto breaks = [&](double rate) {
    rod.duration = 4;
    // Command in V: E = 3 N m / V. Begins at what holds the weight without friction.
    rod.more = fmt::format("cpg: {{type: equations, model: {{states: {{x: {}}}, initial: {{x: {}}}, output: x}}}}", rate / 3,
                           rod.angle + weight / 3);
    const Recording record = run(rod.read());
    const Table table(record.trace);
    std::size_t row = 0;
    while (row < record.trace.rows() && table.at(row, "joint.0.speed") == 0) ++row;
    EXPECT_LT(row, record.trace.rows());
    return 3 * (table.at(row - 1, "joint.0.setpoint") - rod.angle);  // N m
  };
  // A control period is 2e-4 N m of the motor; the row before the first that moves is one or two periods early.
  EXPECT_NEAR(breaks(0.2), (weight + kDry) / eta, 2e-3 * weight) << "lifts";
  EXPECT_NEAR(breaks(-0.2), (weight - kDry) * eta, 2e-3 * weight) << "is driven";
}

/// Bullet's own solver holds a joint, and the rows show what it holds.
TEST(FrictionInBulletsSolver, HoldsAnArm) {
  if (catalog().engine("bullet") == nullptr) GTEST_SKIP() << "built without Bullet";
  DrivenRod rod{"bullet", "{type: torque, dry_friction: 2}"};
  rod.angle = 0.3;
  rod.physics = "step: 1e-3";
  rod.duration = 1;
  const Recording record = run(rod.read({"contact.law=bullet", "trace.columns=[joint.*]"}));
  // The row of the solver is linear below 1e-5 rad/s: at most 1e-5 rad in a second. Its iteration ends at some 1e-3 of a
  // torque.
  EXPECT_NEAR(end(record, "joint.0.angle"), 0.3, 1e-4);
  EXPECT_NEAR(end(record, "joint.0.torque"), kRodWeight * std::sin(0.3), 0.01 * kRodWeight);
}

/// A snapshot goes on in another simulation with the same bits: joints at rest have no memory outside the state.
TEST(FrictionLanes, GoOnFromASnapshot) {
  const std::vector<std::vector<std::string>> own{{"actuator.dry_friction=0.1", "actuator.efficiency_model=directional"},
                                                  {},
                                                  {"actuator.dry_friction=1.9"},
                                                  {"actuator.dry_friction=1e-12"}};
  const std::vector<Scenario> all = rollouts(
      kScenarios + "hexapod.yaml", {"physics.engine=articulated", "physics.estimate=off", "duration=2"}, own, catalog());
  const auto go = [](Simulation& simulation, int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
    return std::vector<double>(simulation.state().begin(), simulation.state().end());
  };
  Simulation first(all);
  for (int part = 0; part < 10; ++part) {  // joints rest and turn, each at other times
    const std::vector<double> snapshot = go(first, 20);
    Simulation second(all);
    std::copy(snapshot.begin(), snapshot.end(), second.state().begin());
    EXPECT_EQ(go(first, 20), go(second, 20)) << part;
  }
}

/// Servos with their usual losses and faults side by side have the bits of each alone.
TEST(FrictionLanes, HoldForServosWithFaults) {
  const auto fault = [](const char* kind) {
    return std::vector<std::string>{fmt::format("at=[{{t: 0.2, fault: {{joint: m1/hinge, {}}}}}]", kind)};
  };
  const std::vector<std::vector<std::string>> own{{},
                                                  fault("kind: open"),
                                                  fault("kind: dead"),
                                                  fault("kind: stuck"),
                                                  fault("kind: weak, share: 0.5"),
                                                  {"actuator.dry_friction=0"},
                                                  {"actuator.stall_torque_at=joint"}};
  const std::vector<Scenario> all = rollouts(kScenarios + "library/y1-snake.yaml",
                                             {"physics.estimate=off", "physics.accuracy=0.01", "duration=0.6"}, own, catalog());
  for (const std::size_t lanes : {1U, 4U, 8U}) {
    std::vector<std::string> ends(all.size());
    run_batch(all, {1, lanes}, [&](std::size_t i, Recording&& end) { ends[i] = bits(end, end.outcome.text()); });
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(ends[i], alone(all[i])) << i << ", " << lanes << " lanes";
  }
}

/// Joints with and without friction side by side have the bits of each alone.
TEST(FrictionLanes, HaveTheBitsOfEachAlone) {
  const std::vector<std::vector<std::string>> own{{},
                                                  {"actuator.dry_friction=0.1", "actuator.viscous_friction=0.09"},
                                                  {"actuator.dry_friction=1.9"},
                                                  {"actuator.dry_friction=1e-12"},
                                                  {"actuator.dry_friction=0.1", "actuator.i_max=0.2"},
                                                  {"actuator.viscous_friction=0.3"},
                                                  {"actuator.dry_friction=0.02", "actuator.efficiency_model=directional"},
                                                  {"actuator.dry_friction=3"},
                                                  {"actuator.dry_friction=0.05", "cpg.frequency=0.8"}};
  const std::vector<Scenario> all = rollouts(
      kScenarios + "hexapod.yaml", {"physics.engine=articulated", "physics.estimate=off", "duration=0.6"}, own, catalog());
  for (const std::size_t lanes : {1U, 4U, 8U}) {
    std::vector<std::string> ends(all.size());
    run_batch(all, {1, lanes}, [&](std::size_t i, Recording&& end) { ends[i] = bits(end, end.outcome.text()); });
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(ends[i], alone(all[i])) << i << ", " << lanes << " lanes";
  }
}

}  // namespace
}  // namespace gaitlab::test
