// Tests of the actuator `servo`: constants computed from a data sheet agree with the data sheet, dc_motor and published
// constants.
#include "actuators/servo.h"

#include <cmath>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sections.h"
#include "core/settings/joint_patterns.h"
#include "report/analysis/envelope.h"
#include "report/analysis/motors.h"
#include "report/analysis/summary.h"
#include "report/verdict/demand.h"
#include "report/verdict/verdict.h"
#include "report/verdict/warnings.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// Walks of both engines.
const Label kServoWalk("Servo.IsADcMotorBitForBit", "long;unsanitized");

/// Servos of the tests. AX-12 at 10 V: 16.5 kgf cm, 0.196 s per 60 degrees, 0.9 A (from its manual). SG92R at 4.8 V: 2.5 kgf
/// cm, 0.12 s per 60 degrees.
const std::string kAx12 = "voltage: 10, stall_torque: 1.618, no_load_speed: 5.343, stall_current: 0.9";
const std::string kSg92r = "voltage: 4.8, stall_torque: 0.24517, no_load_speed: 8.7266";
const std::string kBare = ", load_friction: 0, dry_friction: 0, viscous_friction: 0, rotor_inertia: 0";  // no losses

std::string worm(const std::string& servo, const std::string& more = {}) {
  return "gaitlab: 1\nrobot: {modules: mtran, build: robots/caterpillar-8.dat}\nphysics: {engine: articulated}\n"
         "contact: {on: all}\ncpg: {type: phase_oscillator, frequency: 0.25, amplitude: 0.6, phase_lag: 1.2}\nduration: 1.5\n"
         "actuator: {type: servo, " +
         servo + "}\n" + more;
}

DcMotor motor(const std::string& servo) {
  const Scenario s = scenario(worm(servo));
  return make_actuator(s.actuator, info(*s.robot))->dc_motors()[0];
}

void expect_refused(const std::string& servo, const std::string& expected) {
  try {
    scenario(worm(servo));
    ADD_FAILURE() << servo << " is taken";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U) << error.what();
    EXPECT_TRUE(contains(error.problems()[0].text, expected)) << error.what();
  }
}

TEST(Servo, ImpliesTheConstantsOfTheMotor) {
  const DcMotor ax12 = motor(kAx12);   // tolerances are half of the last digit of the data
  EXPECT_NEAR(ax12.Kt, 1.8717, 1e-4);  // 10 / 5.343 = 1.87161
  EXPECT_EQ(ax12.Kt, ax12.Ks);
  EXPECT_EQ(ax12.gear, 1);
  EXPECT_NEAR(ax12.efficiency, 0.96055, 5e-6);
  EXPECT_NEAR(ax12.R, 11.111, 5e-4);
  EXPECT_EQ(ax12.u_max, 10);
  EXPECT_NEAR(ax12.i_max, 0.9, 1e-15);
  const DcMotor sg92r = motor(kSg92r);
  EXPECT_NEAR(sg92r.R, 7.5382, 5e-5);
  EXPECT_NEAR(sg92r.i_max, 0.63676, 5e-6);
  EXPECT_NEAR(sg92r.efficiency, 0.7, 1e-15);
}

TEST(Servo, IsTheStraightLineOfItsDataSheet) {
  for (const std::string& servo : {kAx12, kSg92r, kSg92r + ", efficiency: 0.35"}) {
    const DcMotor m = motor(servo + kBare);
    const double V = m.u_max;
    const double T0 = servo == kAx12 ? 1.618 : 0.24517;
    const double w0 = servo == kAx12 ? 5.343 : 8.7266;
    const double rounding = 8 * T0 * std::numeric_limits<double>::epsilon();  // rounding errors of eight operations
    EXPECT_NEAR(m(V, 0).torque, T0, rounding);
    EXPECT_EQ(m(V, 0).saturation(), 0) << "at rest the current is the limit, not above it";
    EXPECT_NEAR(m(V, w0).torque, 0, rounding);
    for (const double u : {-1.0, -0.3, 0.4, 1.0}) {
      for (const double w : {-0.5, 0.0, 0.25, 0.5}) {
        const double line = u - w;  // torque as a share of T0; the current limit is the stall current
        if (std::abs(line) < 1) {
          EXPECT_NEAR(m(u * V, w * w0).torque, T0 * line, rounding) << u << ", " << w;
        }
        EXPECT_LE(std::abs(m(u * V, w * w0).torque), T0 + rounding) << u << ", " << w;
      }
    }
  }
}

/// A run with a servo has the torques of a run with a dc_motor that has the computed constants.
TEST(Servo, IsADcMotorBitForBit) {
  const std::string own = kAx12 + ", load_friction: 0, dry_friction: 0.05, viscous_friction: 0.02, rotor_inertia: 1e-4";
  const DcMotor m = motor(own);
  std::string text = worm(kAx12);
  const std::size_t at = text.find("actuator: {");
  text.replace(at, text.find('}', at) - at,
               fmt::format("actuator: {{type: dc_motor, R: {}, Kt: {}, Ks: {}, gear: 1, efficiency: {}, u_max: {}, i_max: {}, "
                           "dry_friction: 0.05, viscous_friction: 0.02, rotor_inertia: 1e-4",
                           m.R, m.Kt, m.Ks, m.efficiency, m.u_max, m.i_max));
  for (const char* engine : {"articulated", "bullet"}) {
    if (catalog().engine(engine) == nullptr) continue;
    const std::vector<std::string> sets{std::string("physics.engine=") + engine, "duration=0.3", "trace.columns=[joint.*]"};
    const Trace mine = run(scenario(worm(own), sets)).trace;
    const Trace other = run(scenario(text, sets)).trace;
    EXPECT_GT(std::abs(mine.at(mine.rows() - 1, mine.find("joint.0.torque"))), 0) << engine;
    EXPECT_EQ(hash(mine), hash(other)) << engine;
  }
}

/// Without statements a servo has friction by its sheet; key by key, a stated number replaces it.
TEST(Servo, HasUsualLosses) {
  const auto made = [](const std::string& servo) { return make_motors(scenario(worm(servo))); };
  const auto usual = made(kSg92r);
  const double b = 0.24517 / 8.7266;
  EXPECT_NEAR(usual->friction()[0].dry, 0.03 * 0.24517, 1e-15);
  EXPECT_NEAR(usual->friction()[0].viscous, 0.1 * b, 1e-15);
  EXPECT_NEAR(usual->reflected_inertia()[0], 0.03 * b, 1e-15);
  const DcMotor& m = usual->dc_motors()[0];
  EXPECT_NEAR(m.load, 0.85 / 1.15, 1e-15);
  EXPECT_NEAR(m(4.8, 1).torque, m.load * 0.24517 * (1 - 1 / 8.7266), 1e-14) << "drives";
  EXPECT_NEAR(m(2, 5).torque, 0.24517 * (2 / 4.8 - 5 / 8.7266) / m.load, 1e-14) << "is driven";
  EXPECT_NEAR(m.on(1, 4.8, 0).torque, m.load * 0.24517, 1e-15) << "lifts";
  EXPECT_NEAR(m.on(-1, 4.8, 0).torque, 0.24517 / m.load, 1e-14) << "holds";
  const auto stated = made(kSg92r + ", dry_friction: 0");
  EXPECT_EQ(stated->friction()[0].dry, 0);
  EXPECT_EQ(stated->friction()[0].viscous, usual->friction()[0].viscous);
  EXPECT_TRUE(made(kSg92r + kBare)->friction().empty());
}

/// The driven joint then has its sheet's torque at rest, and none at its speed.
TEST(Servo, MayHaveTheSheetOfTheJoint) {
  const auto motors = make_motors(scenario(worm(kSg92r + ", stall_torque_at: joint")));
  const DcMotor& m = motors->dc_motors()[0];
  const JointFriction& lost = motors->friction()[0];
  EXPECT_NEAR(m.on(1, 4.8, 0).torque - lost.dry, 0.24517, 1e-14);
  EXPECT_NEAR(m(4.8, 8.7266).torque - lost.dry - lost.viscous * 8.7266, 0, 1e-14);
}

/// No part of a servo creates energy, whoever drives.
TEST(Servo, CreatesNoEnergy) {
  for (const std::string& servo : {kAx12, kSg92r, kSg92r + kBare}) {
    const auto motors = make_motors(scenario(worm(servo)));
    const DcMotor& m = motors->dc_motors()[0];
    for (int u = -8; u <= 8; ++u) {
      for (int w = -8; w <= 8; ++w) {
        const DcMotor::Effort e = m(0.25 * u * m.u_max, 1.25 * w);
        EXPECT_GE(e.gear, -1e-14) << servo << " " << u << " " << w;  // rounding errors of powers of some W
      }
    }
  }
}

TEST(Servo, RefusesWhatNoMotorCanDo) {
  expect_refused("voltage: 10, stall_torque: 1.8, no_load_speed: 5.34, stall_current: 0.5",
                 "stall_torque 1.8 N m at 0.5 A and 5.34 rad/s at 10 V would need an efficiency of 1.92; at most 1");
  expect_refused("voltage: 10, stall_torque: {default: 1, m3/active: 1.8}, no_load_speed: 5.34, stall_current: 0.6",
                 "stall_torque 1.8 N m at 0.6 A and 5.34 rad/s at 10 V would need an efficiency of 1.6; at most 1 (joint "
                 "number 6)");
  // Data of the XL430-W250-T (1.5 N m, 61 rev/min at 12 V and 1.4 A) in the units of shops are refused with a hint.
  expect_refused("voltage: 12, stall_torque: 15.3, no_load_speed: 6.388, stall_current: 1.4",
                 "is the torque in kgf cm (15.3 kgf cm are 1.5 N m)");
  expect_refused("voltage: 12, stall_torque: 1.5, no_load_speed: 61, stall_current: 1.4",
                 "(61 rev/min are 6.388 rad/s), or is voltage the supply? The data hold at `voltage`; the supply is u_max");
  expect_refused("voltage: 12, stall_torque: 1.5, no_load_speed: 6.388, stall_current: 1400",
                 "at least 0.01: is the current in mA, or the voltage in mV?");
  expect_refused("voltage: 12, stall_torque: 1.5, no_load_speed: 6.388, stall_current: 1.4, i_continuous: 2",
                 "i_continuous 2 A is above stall_current, 1.4 A");
  expect_refused(kAx12 + ", efficiency: 0.7",
                 "efficiency and stall_current are both stated, but one follows from the other; remove one of them");
  expect_refused("voltage: 10, stall_torque: 1, no_load_speed: 5, viscous_friction: 0.2, stall_torque_at: joint",
                 "viscous_friction 0.2 N m s/rad takes all of stall_torque at no_load_speed; expected below 0.2 N m s/rad");
  expect_refused(kAx12 + ", stall_torque_at: joint", " V, raised by stall_torque_at: joint, would need an efficiency of ");
  expect_refused("voltage: 10, stall_torque: 1.8", "missing key 'no_load_speed'");
  expect_refused("voltage: 10, stall_torque: 0, no_load_speed: 5",
                 "stall_torque is 0 N m; expected more than 0 and up to 1000000000 N m");
  EXPECT_EQ(motor("voltage: 10, stall_torque: 2, no_load_speed: 5, stall_current: 1").efficiency, 1) << "exactly what it takes";
}

TEST(Servo, PerJointAndByPattern) {
  const Scenario s =
      scenario(worm("voltage: {default: 10, \"*/passive\": 5}, stall_torque: 2, no_load_speed: 5, "
                    "stall_current: {m0/*: 2}, u_max: {m1/active: 6}"));
  const auto actuator = make_actuator(s.actuator, info(*s.robot));
  const auto of = [&](const std::string& joint) {
    return actuator->dc_motors()[joints_of(joint, joint_names(*s.robot)).at(0)];
  };
  EXPECT_EQ(of("m0/active").u_max, 10);
  EXPECT_EQ(of("m0/passive").u_max, 5) << "the default follows its joint's voltage";
  EXPECT_EQ(of("m1/active").u_max, 6);
  EXPECT_EQ(of("m1/active").i_max, 10 / of("m1/active").R) << "the stall current at `voltage`";
  EXPECT_EQ(of("m0/active").efficiency, 0.5);
  EXPECT_NEAR(of("m1/active").efficiency, 0.7, 1e-15);
  const std::string once = resolved(s);
  EXPECT_EQ(resolved(scenario(once)), once);
}

/// Limits without a setting follow from the data sheet, also if the module type and the scenario each set a part of the data.
TEST(Servo, DefaultLimitsFollowTheVoltage) {
  const auto limits = [](const std::string& servo, const std::vector<std::string>& sets) {
    const Scenario s = scenario(worm(servo), sets);
    const DcMotor m = make_actuator(s.actuator, info(*s.robot))->dc_motors()[0];
    return std::pair(m.u_max, m.i_max * m.R);
  };
  EXPECT_EQ(limits(kAx12, {"actuator.voltage=12"}).first, 12);
  EXPECT_EQ(limits(kAx12 + ", u_max: 0", {}).first, 10);
  EXPECT_NEAR(limits(kAx12, {"actuator.u_max=5"}).second, 10, 1e-14);
}

/// Motors of a module type with two hinges under settings of the scenario.
class ServoModule : public testing::Test {
 protected:
  static std::vector<DcMotor> motors(const std::string& servo, const std::string& of_second,
                                     const std::vector<std::string>& sets) {
    const Scenario s = scenario(fmt::format(R"(
gaitlab: 1
robot:
  modules:
    gaitlab_module: 1
    name: arm
    bodies:
      support: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      upper: {{mass: 0.2, com: [0, 0, -0.05], inertia: [1e-3, 1e-3, 1e-3, 0, 0, 0]}}
      lower: {{mass: 0.1, com: [0, 0, -0.05], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}}
    hinges:
      - {{name: one, parent: support, child: upper, axis: [0, 1, 0], range: [-1, 1]}}
      - {{name: two, parent: upper, child: lower, origin: [0, 0, -0.1], axis: [0, 1, 0], range: [-1, 1], actuator: {{{}}}}}
    actuator: {{type: servo, source: data sheet 17, {}}}
ground: {{type: none}}
contact: {{on: none}}
physics: {{engine: articulated}}
cpg: {{type: phase_oscillator, frequency: 1, amplitude: 0.3}}
duration: 0.1
)",
                                            of_second, servo),
                                sets);
    const auto actuator = make_actuator(s.actuator, info(*s.robot));
    return {actuator->dc_motors()[0], actuator->dc_motors()[1]};
  }
};

TEST_F(ServoModule, DefaultLimitsFollowWhereHingesHaveOthers) {
  const std::string small = "voltage: 6, stall_torque: 0.5, no_load_speed: 5, stall_current: 1";
  const double rounding = 3 * 4 * std::numeric_limits<double>::epsilon();  // rounding errors of u / (V / I0)
  for (const DcMotor& m : motors(small, "stall_torque: 1", {"actuator.stall_current=3"})) EXPECT_NEAR(m.i_max, 3, rounding);
  for (const DcMotor& m : motors(small, "stall_torque: 1", {"actuator.voltage=12"})) EXPECT_EQ(m.u_max, 12);
  // A setting of one hinge applies only to this hinge.
  const std::vector<DcMotor> one = motors(small, "i_max: 0.4", {"actuator.stall_current=3"});
  EXPECT_NEAR(one[0].i_max, 3, rounding);
  EXPECT_EQ(one[1].i_max, 0.4);
}

TEST_F(ServoModule, AStatedLimitStaysWhereItIsTheDefault) {
  const std::string stated = "voltage: 6, stall_torque: 0.5, no_load_speed: 5, stall_current: 1, u_max: 6, i_max: 1";
  for (const std::string of_second : {"stall_torque: 0.5", "stall_torque: 1"}) {
    for (const DcMotor& m : motors(stated, of_second, {"actuator.voltage=12", "actuator.stall_current=3"})) {
      EXPECT_EQ(m.u_max, 6) << of_second;
      EXPECT_EQ(m.i_max, 1) << of_second;
    }
  }
}

TEST(Servo, TheVerdictAsksIt) {
  const Scenario s =
      scenario(worm(kSg92r + kBare + ", i_continuous: 0.2, gear_torque_peak: 0.2, gear_torque_continuous: 0.1, speed_max: 8"));
  EXPECT_NEAR(report::rest_torques(s).at(0), 0.24517, 1e-12);
  const report::Motors motors = report::motors(s, 1);
  const report::Envelope& envelope = motors.joint(0);
  EXPECT_EQ(envelope.unit, "V");
  EXPECT_EQ(envelope.command, 4.8);
  EXPECT_NEAR(*envelope.rest, 0.24517, 1e-12);
  EXPECT_NEAR(*envelope.no_load, 8.7266, 1e-3);  // tolerance of the bisection
  EXPECT_EQ(envelope.continuous, 0.2);
  EXPECT_EQ(envelope.gear_peak, 0.2);
  EXPECT_EQ(envelope.gear_continuous, 0.1);
  EXPECT_EQ(envelope.speed_max, 8);
  const Recording record = run(s);
  const report::Summary summary = report::summarise(s, record, 0);
  const report::Verdict verdict = report::verdict(s, record, summary, report::overlaps(s, record));
  for (const char* id : {"voltage", "current", "envelope", "heat", "gear_peak", "gear_continuous"}) {
    const auto check = std::ranges::find(verdict.checks, id, &report::Check::id);
    ASSERT_NE(check, verdict.checks.end()) << id;
    EXPECT_NE(check->status, report::CheckStatus::not_judged) << id;
  }
}

TEST(Servo, TheDemandTwinHasItsLimitsRaised) {
  Scenario twin = scenario(worm(kSg92r));
  ASSERT_TRUE(report::raise_limits(twin));
  const DcMotor free = make_actuator(twin.actuator, info(*twin.robot))->dc_motors()[0];
  const DcMotor own = motor(kSg92r);
  EXPECT_EQ(free.u_max, report::kDemandTimes * own.u_max);
  EXPECT_EQ(free.i_max, report::kDemandTimes * own.i_max);
  EXPECT_EQ(free.R, own.R);
  EXPECT_EQ(free.efficiency, own.efficiency);
}

/// The second run for the demand has 20 times the limits of each joint, whether set or computed. The resolved scenario contains
/// the same limits.
TEST(Servo, TheDemandTwinRaisesEveryJointsOwnLimits) {
  const std::string text =
      worm("voltage: {default: 10, m0/*: 5}, stall_torque: 2, no_load_speed: 5, u_max: {m1/active: 6}, i_max: {m2/*: 0.3}");
  const Scenario s = scenario(text);
  const auto own = make_actuator(s.actuator, info(*s.robot));
  for (const std::string& of : {text, resolved(s)}) {
    Scenario twin = scenario(of);
    ASSERT_TRUE(report::raise_limits(twin));
    const auto free = make_actuator(twin.actuator, info(*twin.robot));
    for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
      EXPECT_EQ(free->dc_motors()[j].u_max, report::kDemandTimes * own->dc_motors()[j].u_max) << j;
      EXPECT_EQ(free->dc_motors()[j].i_max, report::kDemandTimes * own->dc_motors()[j].i_max) << j;
    }
  }
}

/// The program warns of a gain that is too large for a servo. In 15 ms, Kp 100 turns the joint by 100 * 0.015 * 8.7266 / 4.8
/// = 2.727 times its error, Kp 26 by 0.709 times.
TEST(Servo, TooLargeAGainIsTold) {
  const auto told = [](const std::string& Kp) {
    return report::setup_warnings(scenario(worm(kSg92r, "controller: {type: pid, Kp: " + Kp + ", Kd: 0}\n")));
  };
  ASSERT_EQ(told("100").size(), 1U);
  EXPECT_EQ(told("100")[0].text,
            "Kp 100 of joint m0/active is too large for commands every 0.015 s: the joint may not settle (gain 2.727 per "
            "command, at most 2); take Kp: 73 or less, or controller.period: 0.011 or less");
  EXPECT_TRUE(told("26").empty());
}

/// Ratings of a module type have the source of the module type, and so do limits that are computed from these ratings.
TEST(Servo, SourcesAreOfWhatTheModuleTypeStates) {
  const Folder folder;
  std::string type = read(kScenarios + "modules/mtran.yaml");
  type.replace(type.find("\nactuator:"), std::string::npos,
               "\nactuator: {type: servo, " + kAx12 + kBare + ", source: data sheet 17}\n");
  folder.write("own.yaml", type);
  const auto source = [&](const std::string& more) {
    const std::string path = folder.write("s.yaml", "gaitlab: 1\nrobot: {modules: ./own.yaml}\nduration: 0.1\n" + more);
    return report::motor_source(read_scenario(path, {}, catalog()));
  };
  EXPECT_EQ(source(""), "data sheet 17");
  EXPECT_EQ(source("actuator: {u_max: 9}\n"), "chosen: no source stated for u_max of the scenario; the rest: data sheet 17");
  EXPECT_EQ(source("actuator: {stall_torque: 1.5, source: bench}\n"),
            "stall_torque of the scenario: bench; the rest: data sheet 17");
}

}  // namespace
}  // namespace gaitlab::test
