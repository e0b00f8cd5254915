// Motor, controller and oscillators of the program agree with closed forms.
#include <cmath>

#include "tests/oracles/drives.h"
#include "tests/program/fixture.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

/// Scenario text of a flywheel of 0.05 kg m^2 on a fixed support. `com` is its centre of mass, which may be off the axis.
std::string flywheel(const std::string& com) {
  return fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 0]
  modules:
    name: flywheel
    bodies:
      support: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      wheel: {{mass: 1, com: {}, inertia: [0.05, 0.05, 0.05, 0, 0, 0]}}
    hinges:
      - {{name: axle, parent: support, child: wheel, axis: [0, 1, 0], range: [-1000, 1000]}}
ground: {{type: none}}
contact: {{on: none}}
)",
                     com);
}

const std::string kMotorEquations = "closed form of eq. 1, 2 (docs/equations.md, 3)";

/// Largest errors of the speed at the current limit and afterwards, during 0.3 s at 7.4 V, rad/s.
std::array<double, 2> spin_up(const oracle::MotorSpinUp& motor, double rotor) {
  const Recording record = run(scenario(flywheel("[0, 0, 0]") + fmt::format(R"(
physics: {{integrator: rk4, step: 1e-4}}
actuator: {{rotor_inertia: {}}}
controller: {{type: hold, command: 7.4, period: 1e-3}}
duration: 0.3
trace: {{period: 1e-3, columns: [joint.*]}}
)",
                                                                            rotor)));
  const Table table(record.trace);
  std::array<double, 2> worst{};
  for (std::size_t row = 1; row < record.trace.rows(); ++row) {
    const double t = table.at(row, "t");
    const bool limited = t < motor.limited_until();
    EXPECT_EQ(table.at(row, "joint.0.saturation"), limited ? 2 : 0) << t;
    double& branch = worst[limited ? 0 : 1];
    branch = std::max(branch, std::abs(table.at(row, "joint.0.speed") - motor.speed(t)));
  }
  return worst;
}

TEST(Motor, SpinsUpALoad) {
  oracle::MotorSpinUp motor{4.3, 0.00395, 0.00395, 594, 0.7, 1.2, 7.4, 0.05};
  const std::array<double, 2> worst = spin_up(motor, 0);
  validate_below({"closed.motor.current_limited", "7.4 V on a flywheel, until 24 ms: worst speed", kMotorEquations, "rad/s"},
                 worst[0], 1e-13, "constant torque: rounding of 240 steps");
  const std::string kink = "the torque's slope jumps inside a step of 0.1 ms: at most 39 rad/s^2 * 18/s * (0.1 ms)^2 / 2";
  validate_below(
      {"closed.motor.voltage_limited", "7.4 V on a flywheel, from 24 ms to 0.3 s: worst speed", kMotorEquations, "rad/s"},
      worst[1], 4e-6, kink);
  const double rotor = 1e-7;
  motor.J += motor.n * motor.n * rotor;
  const std::array<double, 2> heavier = spin_up(motor, rotor);
  validate_below({"closed.motor.rotor", "7.4 V on a flywheel, rotor of 1e-7 kg m^2 behind the gear, 0.3 s: worst speed",
                  "closed form of eq. 1, 2 with J + n^2 J_rotor", "rad/s"},
                 std::max(heavier[0], heavier[1]), 4e-6, kink);
}

TEST(Motor, HoldsAWeight) {
  // At rest under 2 V, eta Kt n u / R = m g l sin(q).
  const double torque = 0.7 * 0.00395 * 594 * 2 / 4.3;
  const double angle = std::asin(torque / (9.81 * 0.1));
  const Recording record = run(scenario(flywheel("[0, 0, -0.1]") + fmt::format(R"(
initial: {{angles: {:.17g}}}
physics: {{integrator: rk4, step: 1e-3}}
controller: {{type: hold, command: 2, period: 1e-3}}
duration: 0.5
trace: {{period: 1e-3, columns: [joint.*]}}
)",
                                                                               angle)));
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  validate({"closed.motor.stall_torque", "2 V at rest: torque", kMotorEquations, "N m"}, table.at(last, "joint.0.torque"),
           torque, 1e-14, "rounding of numbers of 1");
  validate({"closed.motor.stall_angle", "2 V hold 1 kg at 0.1 m: angle after 0.5 s", kMotorEquations, "rad"},
           table.at(last, "joint.0.angle"), angle, 1e-14,
           "rounding; an error in the torque would turn it by its 0.7th part a second");
}

TEST(HingeStop, ThrowsBackWhatDampingLeaves) {
  std::string text = flywheel("[0, 0, 0]");
  text.replace(text.find("[-1000, 1000]"), 13, "[-1, 0]");
  // The joint starts at its stop with 1 rad/s. The step is 1 us, because the torque of a stop jumps by cs v at first contact.
  const Recording record = run(scenario(text + R"(
initial: {speeds: 1}
actuator: {type: none}
physics: {integrator: rk4, step: 1e-6}
duration: 0.15
trace: {period: 0.005, columns: [joint.*]}
)"));
  const oracle::StopBounce stop{0.05, 50, 0.5};
  const Table table(record.trace);
  validate({"closed.stop.bounce", "flywheel of 0.05 kg m^2 runs against a hinge stop at 1 rad/s: speed afterwards",
            "closed form of the stop (docs/equations.md, 2)", "rad/s"},
           table.at(record.trace.rows() - 1, "joint.0.speed"), stop.at(stop.lasts(), 1)[1], 1e-5,
           "the torque jumps by cs v inside the step of 1 us in which it touches: h cs / J");
  const std::array<double, 2> deep = stop.at(0.05, 1);
  validate({"closed.stop.depth", "the flywheel 50 ms after it ran against the stop: angle beyond it",
            "closed form of the stop (docs/equations.md, 2)", "rad"},
           table(0.05, "joint.0.angle"), deep[0], 1e-6, "the speed's 1e-5 for 50 ms");
}

TEST(PidLoop, IsTheTextbooks) {
  const Recording record = run(scenario(flywheel("[0, 0, -0.1]") + R"(
physics: {integrator: semi_implicit, step: 1e-3}
controller: {type: pid, period: 0.015, Kp: 3, Ki: 2, Kd: 0.2, N: 5, anti_windup: false}
cpg: {type: sine, frequency: 1, amplitude: 0.5}
duration: 3
trace: {period: 0.015, columns: [joint.*]}
)"));
  oracle::TextbookPid pid(3, 2, 0.2, 5, 0.015);
  const Table table(record.trace);
  double worst = 0;
  // A row contains the angle at its time, and set point and command of the previous control tick.
  for (std::size_t row = 0; row + 1 < record.trace.rows(); ++row) {
    const double command = pid(table.at(row + 1, "joint.0.setpoint") - table.at(row, "joint.0.angle"));
    worst = std::max(worst, std::abs(table.at(row + 1, "joint.0.voltage_command") - command));
  }
  validate_below({"closed.pid.command", "position loop with every gain, sine of 1 Hz, 200 ticks: worst command",
                  "eq. 3-6 written down again and worked by hand", "V"},
                 worst, 1e-13, "rounding of 200 sums of numbers of 1");
}

TEST(PidLoop, DoesNotWindUp) {
  // With a supply of 1 V the command exceeds the supply most of the time, also when the error changes its sign.
  const Recording record = run(scenario(flywheel("[0, 0, -0.1]") + R"(
physics: {integrator: semi_implicit, step: 1e-3}
actuator: {u_max: 1}
controller: {type: pid, period: 0.015, Kp: 50, Ki: 300, Kd: 0.2, N: 20}
cpg: {type: sine, frequency: 3, amplitude: 0.5, model: {ramp: 0.1}}
duration: 3
trace: {period: 0.015, columns: [joint.*]}
)"));
  oracle::PidSums pid(50, 300, 0.2, 20, 0.015, 1);
  const Table table(record.trace);
  double worst = 0;
  int held = 0;
  int turned = 0;
  double before = 0;
  for (std::size_t row = 0; row + 1 < record.trace.rows(); ++row) {
    const double error = table.at(row + 1, "joint.0.setpoint") - table.at(row, "joint.0.angle");
    worst = std::max(worst, std::abs(table.at(row + 1, "joint.0.voltage_command") - pid(error)));
    if (row > 0 && pid.held(row - 1)) {
      ++held;
      turned += before * error < 0 ? 1 : 0;
    }
    before = error;
  }
  EXPECT_GT(held, 20);
  EXPECT_GT(turned, 2);
  EXPECT_LT(worst, 1e-12) << "rounding of 200 sums of numbers of 30";
}

TEST(PhaseChain, LocksAsAdlersEquationSays) {
  // Joint 1 follows joint 0, whose frequency is higher by 0.6 Hz, with a coupling weight of 5/s.
  const std::string mtran = R"(
gaitlab: 1
robot: {modules: mtran, base: fixed, position: [0, 0, 1]}
ground: {type: none}
contact: {on: none}
actuator: {type: none}
physics: {integrator: semi_implicit, step: 1e-3, gravity: [0, 0, 0]}
)";
  const Recording record = run(scenario(mtran + R"(
cpg: {type: phase_oscillator, frequency: [0.85, 0.25], phase_lag: 1.2, step: 1e-3, model: {coupling: 5}}
duration: 3
trace: {period: 0.015, columns: [cpg.*]}
)"));
  const oracle::PhasePair pair{5, 2 * std::numbers::pi * 0.6};
  const Table table(record.trace);
  const auto lag = [&](std::size_t row) { return table.at(row, "cpg.phi.0") + 1.2 - table.at(row, "cpg.phi.1"); };
  double worst = 0;
  for (std::size_t row = 0; row < record.trace.rows(); ++row) {
    // A row contains the states after the control tick one period before its time.
    worst = std::max(worst, std::abs(lag(row) - pair.lag(table.at(row, "t"))));
  }
  const std::string source = "Adler's equation, Proceedings of the IRE 34, 1946";
  validate_below({"closed.phases.lag", "oscillator pulled by a faster one, RK4 at 1 ms: worst lag in 3 s", source, "rad"},
                 worst, 1e-11, "order 4: (1 ms * 5/s)^4 / 120 per step, 300 steps until it has decayed");
  const std::size_t late = 100;  // 1.5 s; within 1 % of the locked lag, the decay is exponential to 1 %
  const double rate = std::log((pair.locked() - lag(late)) / (pair.locked() - lag(late + 20))) / 0.3;
  validate({"closed.phases.decay",
            "oscillator pulled by a faster one, after 1.5 s: rate at which the lag goes to the locked one", source, "1/s"},
           rate, pair.decay(), 0.05, "the deviation still is 1 % of a radian and bends the exponential by as much");
}

TEST(PhaseChain, LocksAllAlong) {
  // Each of sixteen joints follows the joint before it, and the first is faster. Every joint then lags by asin(detuning / w).
  const Recording record = run(scenario(R"(
gaitlab: 1
robot: {modules: mtran, build: robots/caterpillar-8.dat, position: [0, 0, 1]}
ground: {type: none}
contact: {on: none}
actuator: {type: none}
physics: {integrator: semi_implicit, step: 5e-3, gravity: [0, 0, 0]}
cpg: {type: phase_oscillator, frequency: {default: 0.25, m0/active: 0.5}, phase_lag: 1.2, step: 5e-3, model: {coupling: 20}}

duration: 4.5
trace: {period: 0.015, columns: [cpg.*]}
)"));
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  double worst = 0;
  for (int i = 1; i < 16; ++i) {
    const double lead = table.at(last, fmt::format("cpg.phi.{}", i)) - table.at(last, fmt::format("cpg.phi.{}", i - 1));
    worst = std::max(worst, std::abs(lead - (1.2 - std::asin(2 * std::numbers::pi * 0.25 / 20))));
  }
  validate_below(
      {"closed.phases.chain", "chain of 16, the first faster by 0.25 Hz, w = 20/s: worst of the 15 leads after 4.5 s",
       "fixed point: L - asin(detuning / w)", "rad"},
      worst, 1e-12, "exp(-90) * 90^15 / 15! is below rounding of phases of 30 rad");
}

}  // namespace
}  // namespace gaitlab::test
