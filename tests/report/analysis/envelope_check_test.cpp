// The check `envelope` agrees with closed forms for a motor that holds a pendulum and a motor that accelerates a wheel.
#include <cmath>

#include "report/verdict/verdict.h"
#include "tests/oracles/drives.h"
#include "tests/program/fixture.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

constexpr double kGearing = 594;
constexpr double kK = 0.7 * 0.00395 * kGearing;  // N m/A: eta Kt n
constexpr double kVolts = 0.00395 * kGearing;    // V s/rad: Ks n

/// Value of the check `envelope` in the whole run, and in the row of ticks that ends at a given time. The body of 1 kg has its
/// centre of mass `arm` m below the axle, is rotated by 90 degrees, and has a constant voltage.
struct Reached {
  double whole, row;
};
Reached envelope_of(double arm, double voltage, double i_max, double duration, double at = 0) {
  const Scenario s = scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 0]
  modules:
    name: pendulum
    bodies:
      support: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      rod: {{mass: 1, com: [0, 0, {:.17g}], inertia: [0.05, 0.05, 0.05, 0, 0, 0]}}
    hinges:
      - {{name: axle, parent: support, child: rod, axis: [0, 1, 0], range: [-1000, 1000]}}
ground: {{type: none}}
contact: {{on: none}}
initial: {{angles: {:.17g}}}
physics: {{engine: articulated, integrator: extrapolated, step: 1e-4}}
actuator: {{i_max: {}}}
controller: {{type: hold, command: {:.17g}, period: 1e-3}}
duration: {}
trace: {{period: 0.01}}
)",
                                          -arm, arm > 0 ? std::acos(-1.0) / 2 : 0.0, i_max, voltage, duration));
  const Recording record = run(s);
  const report::Verdict made = report::verdict(s, record, report::summarise(s, record, 0), report::overlaps(s, record));
  const Series t(record.ticks, 0);
  const auto row = static_cast<std::size_t>(std::ranges::count_if(t.values(), [&](double one) { return one < at - 1e-9; }));
  return {std::ranges::find(made.checks, "envelope", &report::Check::id)->value, record.tick(0, kEnvelopePeak)[row]};
}

const std::string kEnvelopeLaw = "closed form of eq. 1, 2: T over eta Kt n min(i_max, (u_max - Ks n w) / R)";

/// At rest, T = m g l requires the voltage u = R T / (eta Kt n).
TEST(EnvelopeCheck, OfAPendulumHeldAt90Degrees) {
  const double torque = 9.81 * 0.1;
  const double voltage = 4.3 * torque / kK;
  validate({"limits.envelope.current", "pendulum of 1 kg, 0.1 m held at 90 degrees, 1.2 A at most: envelope of the verdict",
            kEnvelopeLaw, ""},
           envelope_of(0.1, voltage, 1.2, 0.5).whole, torque / (kK * 1.2), 1e-13, "rounding; it turns by less than 1e-13 rad");
  validate({"limits.envelope.voltage", "pendulum of 1 kg, 0.1 m held at 90 degrees, 7.4 V at most: envelope of the verdict",
            kEnvelopeLaw, ""},
           envelope_of(0.1, voltage, 5, 0.5).whole, torque / (kK * 7.4 / 4.3), 1e-13,
           "rounding; it turns by less than 1e-13 rad");
}

/// For a wheel at 5 V the envelope ratio is (5 V - Ks n w) / (7.4 V - Ks n w), which decreases with the speed w. The largest
/// value of the run is at its start, and that of a tick at the start of the tick.
TEST(EnvelopeCheck, OfAWheelThatSpinsUp) {
  const double i_max = 5;
  const oracle::MotorSpinUp motor{4.3, 0.00395, 0.00395, kGearing, 0.7, i_max, 5, 0.05};
  const double back = kVolts * motor.speed(0.02);
  validate({"limits.envelope.turning", "5 V on a flywheel, 5 A at most: envelope of the tick from 20 ms on", kEnvelopeLaw, ""},
           envelope_of(0, 5, i_max, 0.1, 0.021).row, (5 - back) / (7.4 - back), 4e-7,
           "extrapolated is of order 2: (18/s * 0.1 ms)^2 of 1.5 V, times 0.07/V");
}

}  // namespace
}  // namespace gaitlab::test
