// Tests of the motion of hinges without a motor, in every engine, against closed forms for a rod of 1 kg and 1 m, whose inertia
// about its hinge is 1/3 kg m^2.
#include <cmath>

#include "core/laws/passive_hinge.h"
#include "interchange/mjcf.h"
#include "interchange/urdf.h"
#include "tests/messages.h"
#include "tests/program/engines.h"
#include "tests/program/rod.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

struct PassiveRod {
  std::string engine, drive, physics = "integrator: rk4, step: 1e-4", angle = "1e-3", gravity = "[0, 0, -9.81]", contact = {};
  double duration = 4;
  [[nodiscard]] Scenario read(const std::vector<std::string>& sets = {}) const {
    return scenario(rod(", drive: none, " + drive) + fmt::format(R"(
initial: {{angles: {}}}
ground: {{type: none}}
contact: {{on: none{}}}
physics: {{engine: {}, {}, gravity: {}}}
duration: {}
trace: {{period: 0.005, columns: [joint.*, energy.*]}}
)",
                                                                 angle, contact, engine, physics, gravity, duration),
                    sets);
  }
};

/// Angular frequency from the downward zero crossings of the angle, rad/s. Interpolation between rows is linear; near 0 the
/// angle is linear up to the third order.
double frequency(const Recording& record) {
  const Table table(record.trace);
  std::vector<double> crossings;
  for (std::size_t row = 1; row < record.trace.rows(); ++row) {
    const double before = table.at(row - 1, "joint.0.angle");
    const double now = table.at(row, "joint.0.angle");
    if (before > 0 && now <= 0) crossings.push_back(table.at(row, "t") - 0.005 * now / (now - before));
  }
  return crossings.size() < 2
             ? 0
             : 2 * std::numbers::pi * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings[0]);
}

class PassiveHinges : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, PassiveHinges, engines(), engine_name);

TEST_P(PassiveHinges, ASpringMakesAPendulumFaster) {
  const double omega = std::sqrt((kRodWeight + 2) / kRodInertia);  // 4.5514 rad/s
  validate({"closed.passive.spring." + GetParam(), GetParam() + ", rk4 at 0.1 ms: rod on a spring of 2 N m/rad, frequency",
            "sqrt((m g l / 2 + K) / I)", "rad/s"},
           frequency(run(PassiveRod{GetParam(), "stiffness: 2"}.read())), omega, 1e-4,
           "required by the issue; sin q - q at 1e-3 rad is 1e-7 of it, lines between rows 1e-6");
  for (const std::string physics : {"step: 2.5e-5"}) {
    PassiveRod rod{GetParam(), "stiffness: 2"};
    rod.physics = physics;
    // The methods have order 1. The energy error of semi_implicit is omega h, and implicit loses omega^2 h / 2 per second.
    EXPECT_NEAR(frequency(run(rod.read())), omega, 1e-3);
  }
}

TEST_P(PassiveHinges, ADamperTakesItsEnergy) {
  PassiveRod rod{GetParam(), "stiffness: 2, damping: 0.1"};
  const Recording record = run(rod.read());
  const double rate = 0.1 / (2 * kRodInertia);  // 0.15 1/s
  const double omega = std::sqrt((kRodWeight + 2) / kRodInertia - rate * rate);
  const auto amplitude = [&](double t) {
    const double q = Table(record.trace)(t, "joint.0.angle");
    return std::hypot(q, (Table(record.trace)(t, "joint.0.speed") + rate * q) / omega);
  };
  validate({"closed.passive.damper." + GetParam(), GetParam() + ", rk4 at 0.1 ms: the same rod with 0.1 N m s/rad, decay",
            "D / (2 I)", "1/s"},
           std::log(amplitude(0.5) / amplitude(3.5)) / 3, rate, 1e-5, "sin q - q at 1e-3 rad: 1e-7 of the frequency");
}

// Under a torque below the dry friction F, the rod stays where it is, in methods that are implicit; above, it falls.
TEST_P(PassiveHinges, DryFrictionHolds) {
  PassiveRod rod{GetParam(), "friction: 2.4"};
  rod.angle = "0.5";  // 2.35 N m
  rod.physics = "step: auto";
  rod.duration = 5;
  const Recording held = run(rod.read());
  EXPECT_EQ(end(held, "joint.0.angle"), 0.5);
  EXPECT_EQ(end(held, "joint.0.speed"), 0);
  EXPECT_NEAR(end(held, "joint.0.passive_torque"), kRodWeight * std::sin(0.5), 1e-12);
  EXPECT_EQ(held.ledger.hinges, 0);
  rod.drive = "friction: 2.3";
  const Recording falls = run(rod.read());
  // It swings through once, against 2.3 N m, and then rests: kRodWeight (cos b - cos 0.5) = 2.3 (0.5 + b) of the first swing is
  // the energy that friction takes.
  EXPECT_EQ(end(falls, "joint.0.speed"), 0);
  const double rest = end(falls, "joint.0.angle");
  EXPECT_LT(rest, 0.5);
  EXPECT_NEAR(falls.ledger.hinges, 2.3 * (0.5 - rest), 1e-3 * falls.ledger.hinges);
  EXPECT_NEAR(falls.ledger.hinges, kRodWeight * (std::cos(rest) - std::cos(0.5)), 1e-3 * falls.ledger.hinges);
}

// Under an explicit method, such a rod creeps.
TEST_P(PassiveHinges, DryFrictionHoldsButForACreep) {
  PassiveRod rod{GetParam(), "friction: 5, friction_speed: 0.001"};
  rod.angle = "0.5";
  rod.physics = "integrator: rk4, step: 2.5e-5";
  rod.duration = 0.5;
  const Recording record = run(rod.read());
  const double tau = kRodWeight * std::sin(end(record, "joint.0.angle"));
  ASSERT_LT(tau, 5);
  // The creep changes tau by 5e-4 of its value per second. The speed follows with a time constant I w_s / F, which causes an
  // error of 1e-7 of the speed.
  EXPECT_NEAR(end(record, "joint.0.speed"), -0.001 * std::atanh(tau / 5), 1e-6 * 0.001);
  EXPECT_NEAR(end(record, "joint.0.passive_torque"), tau, 1e-5);
}

TEST_P(PassiveHinges, TheLedgerKnowsSpringDamperAndFriction) {
  const auto at = [&](const std::string& step) {
    PassiveRod rod{GetParam(), "stiffness: 2, rest: 0.3, damping: 0.1, friction: 0.2, friction_speed: 0.1"};
    rod.angle = "1.2";
    rod.physics = "step: " + step;
    rod.duration = 2;
    return run(rod.read());
  };
  const Recording coarse = at("4e-5");
  const Ledger fine = at("2e-5").ledger;
  EXPECT_GT(fine.hinges, 0.5);
  EXPECT_LT(std::abs(fine.residual()), 1e-3 * fine.hinges);
  EXPECT_NEAR(fine.residual() / coarse.ledger.residual(), 0.5, 0.1) << "first order";
  EXPECT_EQ(fine.stops, 0);
  EXPECT_EQ(end(coarse, "energy.hinges"), coarse.ledger.hinges);
  // The work of a spring is stored energy. Without gravity, damper and friction it is the only term.
  PassiveRod alone{GetParam(), "stiffness: 2, rest: 0.3"};
  alone.gravity = "[0, 0, 0]";
  alone.angle = "1.2";
  const Recording free = run(alone.read());
  const double begin = 2 * 0.9 * 0.9 / 2;
  EXPECT_NEAR(end(free, "energy.kinetic") + 2 * std::pow(end(free, "joint.0.angle") - 0.3, 2) / 2, begin, 1e-10);
  EXPECT_LT(std::abs(free.ledger.stored), 1e-10);
  EXPECT_EQ(free.ledger.hinges, 0);
}

// A stiff spring or steep friction limits the step of an explicit method, and the error message contains the joint.
TEST(PassiveHinge, SetsTheLargestExplicitStep) {
  PassiveRod stiff{catalog().engines().front(), "stiffness: 1000, damping: 20"};
  const auto error = [&](const std::string& step) {
    stiff.physics = "integrator: rk4, step: " + step;
    return message_of([&] { run(stiff.read({"duration=0.1", "trace.period=0.1"})); });
  };
  // The limit h (D + h K) / I = 1 is at h = 0.010814 s.
  EXPECT_EQ(error("0.01"), kNoError);
  EXPECT_TRUE(contains(error("0.0125"), "spring, damper and friction of joint m0/swing")) << error("0.0125");
}

TEST(PassiveHinge, TheSolverHasItsRow) {
  const auto engines = catalog().engines();
  if (std::ranges::find(engines, "bullet") == engines.end()) GTEST_SKIP() << "built without Bullet";
  PassiveRod rod{"bullet", "stiffness: 2, damping: 0.1, friction: 0.05, friction_speed: 0.05"};
  rod.contact = ", law: bullet";
  rod.angle = "1";
  rod.physics = "step: 1e-4";
  rod.duration = 1;
  PassiveRod other = rod;
  other.contact = "";
  other.physics = "integrator: rk4, step: 1e-4";
  const Recording solved = run(rod.read());
  const Recording reference = run(other.read());
  EXPECT_NEAR(end(solved, "joint.0.angle"), end(reference, "joint.0.angle"), 1e-3) << "first order: omega^2 h t";
  EXPECT_NEAR(solved.ledger.hinges, reference.ledger.hinges, 1e-3);
}

// Bullet's solver applies dry friction at high speeds. Above 19 friction_speed, tanh is exactly 1 in doubles, and its slope is
// 0.
TEST(PassiveHinge, TheSolverKeepsDryFrictionAtSpeed) {
  const auto engines = catalog().engines();
  if (std::ranges::find(engines, "bullet") == engines.end()) GTEST_SKIP() << "built without Bullet";
  PassiveRod rod{"bullet", "friction: 2, friction_speed: 0.1"};
  rod.contact = ", law: bullet";
  rod.gravity = "[0, 0, 0]";
  rod.physics = "step: 1e-3";
  rod.duration = 0.1;
  const double w = 3 - 2 * 0.1 / kRodInertia;         // 2.4 rad/s
  const double lost = kRodInertia / 2 * (9 - w * w);  // 0.54 J
  const double rounding =
      100 * 32 * std::numeric_limits<double>::epsilon();  // 100 steps of about ten operations with values of 3 rad/s
  for (const std::string way : {"", "-"}) {
    const Recording record = run(rod.read({"initial.speeds=[" + way + "3]"}));
    EXPECT_NEAR(std::abs(end(record, "joint.0.speed")), w, rounding) << way;
    EXPECT_NEAR(end(record, "energy.hinges"), lost, rounding) << "an impulse works at the mean of the speeds it joins";
    EXPECT_LT(std::abs(record.ledger.residual()), rounding);
  }
  // The friction impulse of one step would reverse the speed of the hinge. The hinge must stop instead.
  rod.drive = "friction: 2000, friction_speed: 0.1";
  const Recording stopped = run(rod.read({"initial.speeds=[3]"}));
  EXPECT_LT(std::abs(end(stopped, "joint.0.speed")), 1e-12);
  EXPECT_NEAR(end(stopped, "energy.hinges"), kRodInertia / 2 * 9, rounding);
}

// Rollouts with different springs in the lanes of one simulation have the same bits as each rollout alone.
TEST(PassiveHinge, LanesDoNotMeet) {
  const std::vector<std::size_t> widths = catalog().engine("articulated")->lanes;
  for (const std::size_t width : widths) {
    std::vector<Scenario> lanes;
    for (std::size_t l = 0; l < width; ++l) {
      PassiveRod rod{"articulated",
                     fmt::format("stiffness: {}, damping: 0.{}, friction: 0.1, friction_speed: 0.{}", l, l + 1, l + 1)};
      rod.angle = fmt::format("0.{}", l + 1);
      rod.physics = "step: auto";
      rod.duration = 0.3;
      lanes.push_back(rod.read());
    }
    Simulation together(lanes);
    together.run();
    for (std::size_t l = 0; l < width; ++l) {
      EXPECT_EQ(together.take_recording(l).trace.values, run(lanes[l]).trace.values) << width << ", " << l;
    }
  }
}

// Robot with a castor between two driven hinges. Columns, summary and results of motors omit the castor.
const std::string kCart = R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 1]
  modules:
    gaitlab_module: 1
    name: arm
    bodies:
      support: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}
      upper: {mass: 0.2, com: [0, 0, -0.05], inertia: [1e-3, 1e-3, 1e-3, 0, 0, 0]}
      tail: {mass: 0.1, com: [0, 0, -0.05], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}
      tip: {mass: 0.1, com: [0, 0, -0.05], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}
    hinges:
      - {name: one, parent: support, child: upper, axis: [0, 1, 0], range: [-1, 1]}
      - {name: castor, parent: upper, child: tail, origin: [0, 0, -0.1], axis: [0, 1, 0], range: free, drive: none, damping: 0.01}
      - {name: two, parent: tail, child: tip, origin: [0, 0, -0.1], axis: [0, 1, 0], range: [-1, 1]}
ground: {type: none}
contact: {on: none}
physics: {engine: articulated}
cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.3, phase_lag: 1}
duration: 1
trace: {columns: ["joint.*", "cpg.*", "energy.*", "reaction.*"]}
)";

std::string with_castor(const std::string& keys) {
  std::string text = kCart;
  const std::string old = "damping: 0.01";
  return text.replace(text.find(old), old.size(), keys);
}

TEST(PassiveHinge, HasNoMotorAmongOthersThatHave) {
  const Scenario s = scenario(kCart);
  const Recording r = run(s);
  for (const char* absent : {"setpoint", "voltage_command", "voltage", "current", "torque", "saturation"}) {
    EXPECT_TRUE(r.joint(1, absent).empty()) << absent;
    EXPECT_FALSE(r.joint(0, absent).empty()) << absent;
  }
  EXPECT_FALSE(r.joint(1, "passive_torque").empty());
  EXPECT_TRUE(r.joint(0, "passive_torque").empty());
  EXPECT_EQ(r.joints[1].torque_peak, 0);
  EXPECT_EQ(r.joints[1].error_peak, 0);
  EXPECT_EQ(r.joints[1].electrical, 0);
  EXPECT_GT(r.joints[2].torque_peak, 0);
  // The last hinge follows the first hinge, the previous hinge with a motor.
  EXPECT_NEAR(end(r, "cpg.phi.2") - end(r, "cpg.phi.0"), 1, 1e-9);
  // The reaction along the axis is the torque of the damper.
  EXPECT_NEAR(end(r, "reaction.1.my"), end(r, "joint.1.passive_torque"), 1e-9);
  EXPECT_NEAR(end(r, "joint.1.passive_torque"), -0.01 * end(r, "joint.1.speed"), 1e-15);
}

TEST(PassiveHinge, IsExported) {
  const Scenario s = scenario(with_castor("stiffness: 0.5, rest: 0.2, damping: 0.01, friction: 0.002"));
  const std::string mjcf = interchange::to_mjcf(s, interchange::MjcfModel::strict);
  EXPECT_TRUE(contains(mjcf, R"(limited="false" stiffness="0.5" springref="0.2" damping="0.01" frictionloss="0.002")")) << mjcf;
  EXPECT_TRUE(contains(mjcf, R"(<motor name="m0/two")"));
  EXPECT_FALSE(contains(mjcf, R"(<motor name="m0/castor")")) << mjcf;
  const std::string urdf = interchange::to_urdf(s);
  EXPECT_TRUE(contains(urdf, R"(<joint name="m0/castor" type="continuous">)")) << urdf;
  EXPECT_TRUE(contains(urdf, R"(<dynamics damping="0.01" friction="0.002"/>)")) << urdf;
  EXPECT_TRUE(contains(urdf, "Springs of hinges: 0.5 N m/rad on m0/castor (at rest at 0.2 rad).")) << urdf;
}

TEST(PassiveHinge, AloneNeedsNoActuator) {
  const PassiveRod alone{"articulated", "stiffness: 1"};
  EXPECT_EQ(alone.read().actuator.entry, nullptr);
  const std::string text = message_of([&] { (void)alone.read({"actuator.type=dc_motor"}); });
  EXPECT_TRUE(contains(text, "an actuator is given, but every hinge of the robot has drive: none")) << text;
}

}  // namespace
}  // namespace gaitlab::test
