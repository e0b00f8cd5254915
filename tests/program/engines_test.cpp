// Results of forces during slip, rolling and impacts at a stop in every engine, compared with closed forms, balances, and
// between engines.
#include "tests/program/engines.h"

#include <cmath>

#include "tests/labels.h"
#include "tests/program/torques.h"

namespace gaitlab::test {
namespace {

// Whole walks of both engines.
const Label kSlippingWalk("Slipping.*", "long;unsanitized");

class Rolling : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Engines, Rolling, engines(), engine_name);

// A ball on an axle that rolls at a constant speed keeps the depth at which the ground carries its weight, for any method,
// because nothing accelerates. The velocity of the contact point depends on base and joint.
TEST_P(Rolling, GoesOnAtTheDepthOfItsWeight) {
  constexpr double kRadius = 0.05;
  constexpr double kDepth = 1.5 * 9.81 / 1e4;  // m g / Kn
  for (const char* base : {"floating", "planar"}) {
    const Recording record = run(scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: {}
  position: [0, 0, {:.17g}]
  modules:
    name: cart
    bodies:
      frame: {{mass: 1, com: [0, 0, -0.02], inertia: [0.001, 0.001, 0.001, 0, 0, 0]}}
      ball: {{mass: 0.5, inertia: [0.0005, 0.0005, 0.0005, 0, 0, 0]}}
    hinges: [{{name: axle, parent: frame, child: ball, axis: [0, 1, 0], range: [-1000, 1000]}}]
    contacts: {{feet: [{{body: ball, sphere: [0, 0, 0], radius: {}}}]}}
initial: {{base_velocity: [1, 0, 0], speeds: {}}}
actuator: {{type: none}}
physics: {{engine: {}}}
duration: 0.2
trace: {{period: 0.01, columns: [joint.*, base.*, contact.*]}}
)",
                                                      base, kRadius - kDepth, kRadius, 1 / kRadius, GetParam())));
    const Table table(record.trace);
    for (std::size_t row = 0; row < record.trace.rows(); ++row) {
      // Rounding errors of a velocity of 1 m/s during 0.2 s are far below a millionth of the depth.
      EXPECT_NEAR(table.at(row, "contact.0.penetration"), kDepth, 1e-6 * kDepth) << base << " " << row;
      EXPECT_NEAR(table.at(row, "contact.0.fn"), 1.5 * 9.81, 1e-6) << base << " " << row;
      EXPECT_NEAR(table.at(row, "base.vx"), 1, 1e-9) << base << " " << row;
      EXPECT_NEAR(table.at(row, "joint.0.speed"), 1 / kRadius, 1e-7) << base << " " << row;
    }
  }
}

// A robot whose feet slide most of the time travels the same distance in both engines, with steps of 0.5 ms of order 1 and 2.
TEST(Slipping, WalksAsFarInBothEngines) {
  const auto walk = [](const std::string& engine) {
    return run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/hexapod.dat}}
ground: {{friction: 0.1}}
contact: {{on: feet}}
cpg: {{type: tripod, frequency: 1, amplitude: 0.4}}
physics: {{{}}}
duration: 1.5
trace: {{columns: [joint.*, com.*]}}
)",
                                    engine)));
  };
  const Recording bullet = walk("engine: bullet, step: 1e-5");
  EXPECT_GT(bullet.ledger.friction, 0.1) << "J";
  struct Bound {
    const char* integrator;
    double travel, torque;
  };
  // Measured errors are 0.00015 and 0.013 (implicit), 0.0001 and 0.0009 (extrapolated). With a wrong sign of the slope of
  // friction along the slip, which affects only the matrix of the step, they are 0.005 and 0.027, 0.0014 and 0.004.
  for (const Bound& bound : {Bound{"implicit", 0.001, 0.02}, Bound{"extrapolated", 0.0005, 0.002}}) {
    const Recording ours = walk(fmt::format("engine: articulated, integrator: {}, step: 5e-4", bound.integrator));
    const auto travel = [](const Recording& r) { return Vec3(r.travel().x(), r.travel().y(), 0); };
    EXPECT_LT((travel(bullet) - travel(ours)).norm() / travel(bullet).norm(), bound.travel) << bound.integrator;
    EXPECT_LT(torques_off(ours, bullet), bound.torque) << bound.integrator << ": RMS of a joint's torque over its peak";
  }
}

}  // namespace
}  // namespace gaitlab::test
