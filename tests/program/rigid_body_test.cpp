// Tops in the program agree with Euler's equations: spatial rotation, and massless bodies between hinges.
#include <cmath>

#include "tests/oracles/tops.h"
#include "tests/program/fixture.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

/// A thrown body without hinges rotates as the elliptic functions predict. Its principal axes are not parallel to its frame or
/// to the world frame.
TEST(Top, TurnsFreelyAsTheEllipticFunctionsSay) {
  const oracle::FreeTop top({0.02, 0.03, 0.04}, 2.2, 4);
  const Mat3 in_body = rpy({0.4, -0.3, 0.7});  // principal axes
  const Mat3 inertia = in_body * Vec3(0.02, 0.03, 0.04).asDiagonal() * in_body.transpose();
  const Vec3 omega = rpy({0.3, 0.2, 0.1}) * in_body * Vec3(2.2, 0, 4);
  const Recording record = run(scenario(fmt::format(R"(
gaitlab: 1
robot:
  position: [0, 0, 1]
  orientation: [0.3, 0.2, 0.1]
  modules: {{name: top, bodies: {{top: {{mass: 2, com: [0.1, -0.2, 0.05], inertia: [{}, {}, {}, {}, {}, {}]}}}}}}
initial: {{base_angular_velocity: [{}, {}, {}], base_velocity: [0.3, 0.2, 0.1]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{integrator: rk4, step: 1e-3, gravity: [1, 2, 3]}}
duration: 3
trace: {{period: 0.05, columns: [base.*, com.*]}}
)",
                                                    inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2),
                                                    inertia(1, 2), omega[0], omega[1], omega[2])));
  const Table table(record.trace);
  const auto vec = [&](std::size_t row, const std::string& name) {
    return Vec3(table.at(row, name + "x"), table.at(row, name + "y"), table.at(row, name + "z"));
  };
  double spin = 0;
  double moment = 0;
  double path = 0;
  const Vec3 arm = rpy({0.3, 0.2, 0.1}) * Vec3(0.1, -0.2, 0.05);
  const Vec3 velocity = Vec3(0.3, 0.2, 0.1) + omega.cross(arm);
  Vec3 momentum = Vec3::Zero();
  for (std::size_t row = 0; row < record.trace.rows(); ++row) {
    const double t = table.at(row, "t");
    const Quat turn(table.at(row, "base.qw"), table.at(row, "base.qx"), table.at(row, "base.qy"), table.at(row, "base.qz"));
    const Vec3 w = vec(row, "base.w");
    const auto expected = top(t);
    spin = std::max(spin, (in_body.transpose() * (turn.conjugate() * w) - Vec3(expected[0], expected[1], expected[2])).norm());
    const Vec3 now = turn * (inertia * (turn.conjugate() * w));
    if (row == 0) momentum = now;
    moment = std::max(moment, (now - momentum).norm() / momentum.norm());
    const Vec3 fall = Vec3(0, 0, 1) + arm + velocity * t + 0.5 * t * t * Vec3(1, 2, 3);
    path = std::max(path, (vec(row, "com.") - fall).norm());
  }
  const std::string reason = "order 4: (1 ms * 5 rad/s)^4 / 100 * 3 s * 5 rad/s, rounded up";
  validate_below(
      {"closed.free_top.spin", "asymmetric body, full inertia tensor, thrown, rk4 at 1 ms: worst angular velocity in 3 s",
       "Jacobi elliptic functions, Landau and Lifshitz, Mechanics, section 37", "rad/s"},
      spin, 1e-9, reason);
  validate_below({"closed.free_top.momentum", "asymmetric body, thrown: worst relative change of the angular momentum in 3 s",
                  "conservation", ""},
                 moment, 1e-10, reason);
  validate_below(
      {"closed.free_top.path", "asymmetric body, thrown, gravity (1, 2, 3): worst distance of the COM from the parabola in 3 s",
       "closed form", "m"},
      path, 1e-10, "base frame off the COM: its error is that of the rotation, times 0.23 m");
}

/// Scenario of a top on a fixed support with hinges about z, x, z (Euler angles) and two massless bodies between them.
Scenario heavy_top(const std::array<double, 3>& speeds, double lean, double duration, double period) {
  return scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 0]
  modules:
    name: top
    bodies:
      support: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      precession: {{mass: 0}}
      nutation: {{mass: 0}}
      top: {{mass: 0.5, com: [0, 0, 0.1], inertia: [1e-3, 1e-3, 5e-4, 0, 0, 0]}}
    hinges:
      - {{name: precession, parent: support, child: precession, axis: [0, 0, 1], range: [-1000, 1000]}}
      - {{name: nutation, parent: precession, child: nutation, axis: [1, 0, 0], range: [-1000, 1000]}}
      - {{name: spin, parent: nutation, child: top, axis: [0, 0, 1], range: [-1000, 1000]}}
initial: {{angles: [0, {}, 0], speeds: [{}, {}, {}]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{integrator: rk4, step: 2.5e-4}}
duration: {}
trace: {{period: {}, columns: [joint.*]}}
)",
                              lean, speeds[0], speeds[1], speeds[2], duration, period));
}

const oracle::HeavyTop kTop{1e-3 + 0.5 * 0.01, 5e-4, 0.5 * 9.81 * 0.1};
const std::string kGoldstein = "Goldstein, Classical Mechanics, 5.7";

TEST(Top, PrecessesSteadily) {
  const double lean = 0.5;
  const double rate = 7;
  const double spin = kTop.spin_for(rate, lean) - rate * std::cos(lean);
  const Recording record = run(heavy_top({rate, 0, spin}, lean, 1, 0.01));
  const Table table(record.trace);
  double nutation = 0;
  for (std::size_t row = 0; row < record.trace.rows(); ++row)
    nutation = std::max(nutation, std::abs(table.at(row, "joint.1.angle") - lean));
  const std::string reason = "constant rates: no truncation error; rounding of 4000 steps of sums of numbers of 100";
  validate_below(
      {"closed.heavy_top.lean", "symmetric top on massless gimbals, started for steady precession: worst change of lean in 1 s",
       kGoldstein, "rad"},
      nutation, 1e-11, reason);
  validate({"closed.heavy_top.precession", "symmetric top in steady precession: its angle after 1 s", kGoldstein, "rad"},
           table.at(record.trace.rows() - 1, "joint.0.angle"), rate, 1e-11, reason);
}

TEST(Top, NutatesBetweenItsLimits) {
  const double lean = 0.5;
  const double spin = 120;
  const Recording record = run(heavy_top({0, 0, spin}, lean, 1, 5e-4));
  const Table table(record.trace);
  double most = 0;
  double least = lean;
  for (std::size_t row = 1; row + 1 < record.trace.rows(); ++row) {
    const auto angle = [&](std::size_t at) { return table.at(at, "joint.1.angle"); };
    least = std::min(least, angle(row));
    if (angle(row) < angle(row - 1) || angle(row) < angle(row + 1)) continue;
    const double slope = (angle(row + 1) - angle(row - 1)) / 2;
    most = std::max(most, angle(row) + slope * slope / (2 * (2 * angle(row) - angle(row + 1) - angle(row - 1))));
  }
  validate({"closed.heavy_top.nutation", "symmetric top let go at 0.5 rad with its axis at rest: where it turns back",
            kGoldstein, "rad"},
           most, kTop.turns_back(lean, spin), 1e-8, "parabola through rows 0.5 ms apart: (0.5 ms * 10 rad/s)^4 * 0.2 rad");
  validate_below(
      {"closed.heavy_top.cusp", "symmetric top let go with its axis at rest: how far it rises above that", kGoldstein, "rad"},
      lean - least, 1e-8, "as the other limit");
}

}  // namespace
}  // namespace gaitlab::test
