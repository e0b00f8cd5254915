// Rotor inertia reflected through the gear, in engine bullet, whose algorithm has no rotor inertia.
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// A rotor inertia equal to that of the rod reduces the frequency of a pendulum by sqrt(2). With Kt = 0 the motor has no torque.
TEST(RotorInertia, OfARodsOwnSizeMakesThePendulumSlowerByTheRootOfTwo) {
  const auto downward_crossing = [](double rotor) {
    const Recording record = run(shipped(
        "pendulum.yaml", {fmt::format("actuator={{type: dc_motor, Kt: 0, gear: 100, rotor_inertia: {}}}", rotor),
                          "physics.step=5e-4", "controller.period=0.005", "duration=1", "trace.columns=[joint.0.angle]"}));
    const Table table(record.trace);
    for (std::size_t row = 1; row < record.trace.rows(); ++row) {
      const double before = table.at(row - 1, "joint.0.angle");
      const double after = table.at(row, "joint.0.angle");
      if (after <= 0) return table.at(row, "t") - 0.005 * after / (after - before);
    }
    return 0.0;
  };
  // The inertia of the rod is m l^2 / 3 = 1/3 kg m^2, and the reflected inertia 1e4 J is equal. The error of the crossing by
  // linear interpolation between rows 5 ms apart is 1e-6 s.
  EXPECT_NEAR(downward_crossing(1.0 / 3e4) / downward_crossing(0), std::sqrt(2.0), 5e-6);
}

TEST(RotorInertia, KeepsMomentumAndEnergyOfAFreeChain) {
  const Recording record = run(scenario(R"(
gaitlab: 1
robot: {modules: mtran, build: robots/caterpillar-8.dat, position: [0, 0, 1], orientation: [0.3, 0.2, 0.1]}
initial: {speeds: {default: 1, m2/passive: -2, m5/active: 1.5}, base_velocity: [0.1, -0.2, 0.3], base_angular_velocity: [0.5, -0.4, 0.3]}
physics: {step: 1e-3, integrator: rk4, gravity: [0, 0, 0]}
ground: {type: none}
contact: {on: none}
actuator: {Kt: 0, rotor_inertia: 1e-8}
duration: 0.2
trace: {period: 0.05, columns: [energy.*, momentum.*, angular_momentum.*]}
)"));
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  // The error of order 4 at 1 ms is about 1e-10 of 1 J, 1 N s, 1 N m s. (Without rotors it is 1e-11 at 1.25 ms.)
  EXPECT_GT(table.at(0, "energy.kinetic"), 0.5);
  EXPECT_NEAR(table.at(last, "energy.stored"), 0, 1e-9);
  for (const char* axis :
       {"momentum.x", "momentum.y", "momentum.z", "angular_momentum.x", "angular_momentum.y", "angular_momentum.z"}) {
    EXPECT_NEAR(table.at(last, axis), table.at(0, axis), 1e-9) << axis;
  }
}

// The time constant of a motor increases with its inertia, and with it the largest stable step.
TEST(RotorInertia, AllowsALongerStep) {
  const auto rate = [](const std::string& rotor) {
    const Scenario s = shipped("caterpillar.yaml", {"physics.integrator=semi_implicit", "actuator.rotor_inertia=" + rotor});
    return Simulation({&s, 1}).standing().rate;
  };
  EXPECT_LT(rate("1e-8"), 0.2 * rate("0"));
  // The motor alone has the decay rate b / n^2 J = 254 / s. For the standing robot, friction has a larger rate.
  EXPECT_GT(rate("1e-8"), 254);
}

}  // namespace
}  // namespace gaitlab::test
