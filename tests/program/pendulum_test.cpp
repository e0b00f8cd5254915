// Pendulums of one and two rods in the program agree with the closed form and Lagrange's equations, to the order of each
// integrator.
#include "tests/oracles/pendulum.h"

#include <cmath>

#include "tests/oracles/double_pendulum.h"
#include "tests/program/engines.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

class Pendulum : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, Pendulum, engines(), engine_name);

TEST_P(Pendulum, SwingsAsTheEllipticFunctionsSay) {
  const Recording record = run(shipped("pendulum.yaml", {"duration=4", set()}));
  const oracle::Pendulum rod(std::sqrt(1.5 * 9.81), 1);
  const Table table(record.trace);
  double angle = 0;
  double energy = 0;
  // Downward zero crossings of the angle. Linear interpolation between rows 5 ms apart has an error below (5 ms)^2 * curvature,
  // which is 1e-6 s.
  std::vector<double> crossings;
  const auto total = [&](std::size_t row) { return table.at(row, "energy.kinetic") + table.at(row, "energy.potential"); };
  for (std::size_t row = 0; row < record.trace.rows(); ++row) {
    const double now = table.at(row, "joint.0.angle");
    angle = std::max(angle, std::abs(now - rod.angle(table.at(row, "t"))));
    energy = std::max(energy, std::abs(total(row) - total(0)));
    const double before = row == 0 ? now : table.at(row - 1, "joint.0.angle");
    if (before > 0 && now <= 0) crossings.push_back(table.at(row, "t") - 0.005 * now / (now - before));
  }
  ASSERT_EQ(crossings.size(), 3U);
  const std::string source = "elliptic integral and functions, Abramowitz and Stegun 16.4, 17.6";
  validate({"closed.pendulum.period", "rod let go at 1 rad, rk4 at 0.1 ms: period", source, "s"},
           (crossings[2] - crossings[0]) / 2, rod.period(), 1e-6, "straight lines between rows 5 ms apart");
  validate_below({"closed.pendulum.angle", "rod let go at 1 rad, rk4 at 0.1 ms: worst angle in 4 s", source, "rad"}, angle,
                 1e-10, "rounding of 4e4 steps, growing with time: 4e4^2 / 2 * 1e-16 * 1e-3");
  validate_below(
      {"closed.pendulum.energy", "rod let go at 1 rad, rk4 at 0.1 ms: worst change of energy in 4 s", "conservation", "J"},
      energy, 1e-10, "order 4 at 0.1 ms: below the rounding of 4e4 steps, 4e4 * 1e-16 * 10 J");
}

/// Run of two rods of 1 kg and 1 m with hinges about y. The angles of the hinges are theta1 and theta2 - theta1.
Recording two_rods(const std::string& engine, const std::string& integrator, double step, double duration) {
  return run(scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 0]
  modules:
    name: two-rods
    bodies:
      support: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      upper: {{mass: 1, com: [0, 0, -0.5], inertia: [0.083333333333333333, 0.083333333333333333, 1e-3, 0, 0, 0]}}
      lower: {{mass: 1, com: [0, 0, -0.5], inertia: [0.083333333333333333, 0.083333333333333333, 1e-3, 0, 0, 0]}}
    hinges:
      - {{name: upper, parent: support, child: upper, axis: [0, 1, 0], range: [-100, 100]}}
      - {{name: lower, parent: upper, child: lower, origin: [0, 0, -1], axis: [0, 1, 0], range: [-100, 100]}}
initial: {{angles: [1, 0.5], speeds: [0.3, -2]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{engine: {}, integrator: {}, step: {}}}
duration: {}
trace: {{period: 0.1, columns: [joint.*, energy.*]}}
)",
                                  engine, integrator, step, duration)));
}

/// Largest error at the end of the two angles from the vertical, rad.
double error(const Recording& record, double duration) {
  const oracle::DoublePendulum::State end = oracle::DoublePendulum{}.at(duration, {1, 1.5, 0.3, -1.7});
  const Table table(record.trace);
  const std::size_t row = record.trace.rows() - 1;
  const double upper = table.at(row, "joint.0.angle");
  const double both = upper + table.at(row, "joint.1.angle");
  return std::max(std::abs(upper - end[0]), std::abs(both - end[1]));
}

class DoublePendulum : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, DoublePendulum, engines(), engine_name);

TEST_P(DoublePendulum, SwingsAsLagrangesEquationsSay) {
  const Recording record = two_rods(GetParam(), "rk4", 2.5e-4, 2);
  const Table table(record.trace);
  const auto total = [&](std::size_t row) { return table.at(row, "energy.kinetic") + table.at(row, "energy.potential"); };
  double energy = 0;
  for (std::size_t row = 0; row < record.trace.rows(); ++row) energy = std::max(energy, std::abs(total(row) - total(0)));
  const oracle::DoublePendulum rods;
  validate({"closed.double_pendulum.energy0", "two rods: energy at the start", "closed form", "J"}, total(0),
           rods.energy({1, 1.5, 0.3, -1.7}), 1e-13, "rounding of a few sums of numbers of 10");

  validate_below({"closed.double_pendulum.angle", "two rods, rk4 at 0.25 ms: worst angle after 2 s",
                  "Lagrange's equations, extrapolation of order 16", "rad"},
                 error(record, 2), 1e-11, "order 4: (0.25 ms * 10 rad/s)^5 / 120 per step, 8000 steps");
  validate_below(
      {"closed.double_pendulum.energy", "two rods, rk4 at 0.25 ms: worst change of energy in 2 s", "conservation", "J"}, energy,
      1e-11, "as the angle");
}

class Integrator : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, Integrator, engines(), engine_name);

TEST_P(Integrator, HasTheOrderItIsSaidToHave) {
  const auto order = [](const std::string& integrator, double step) {
    return std::log2(error(two_rods(GetParam(), integrator, step, 1), 1) /
                     error(two_rods(GetParam(), integrator, step / 2, 1), 1));
  };
  const std::string source = "docs/equations.md, 7; error against Lagrange's equations";
  validate({"order." + first_order(), "two rods, 1 s, 1 ms and 0.5 ms: log2 of the errors' ratio", source, ""},
           order(first_order(), 1e-3), 1, 0.1, "the next order is smaller by the step times the rates, a few per cent");
  validate({"order.rk4", "two rods, 1 s, 5 ms and 2.5 ms: log2 of the errors' ratio", source, ""}, order("rk4", 5e-3), 4, 0.4,
           "the next order is smaller by the step times the rates, 5 ms * 10/s, on either side");
}

}  // namespace
}  // namespace gaitlab::test
