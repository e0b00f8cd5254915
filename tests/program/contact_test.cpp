// Block on four contact points: the program reproduces the analytical friction, depth of rest, oscillation and bounce of
// eq. 12.
#include <cmath>

#include "tests/oracles/blocks.h"
#include "tests/program/block.h"
#include "tests/program/engines.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

/// Block of 1 kg on four points. Its centre of mass is in the plane of the points, so that friction does not tip the block.
Scenario block(const std::string& engine, const std::string& rest, double height, double step, double duration) {
  return scenario(fmt::format(R"(
gaitlab: 1
{}actuator: {{type: none}}
duration: {}
trace: {{period: 1e-3, columns: [base.*]}}
physics: {{engine: {}, integrator: rk4, step: {}{}
)",
                              block_robot(fmt::format("  position: [0, 0, {:.17g}]\n", height)), duration, engine, step, rest));
}

class Block : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, Block, engines(), engine_name);

TEST_P(Block, SlidesAsFarAsFrictionLetsIt) {
  const oracle::SlidingBlock law{0.8, 9.81, 0.01};
  const double sink = oracle::standing_sink(1, 9.81, 4, 1e4);
  const Recording record = run(block(GetParam(), "}\ninitial: {base_velocity: [0.6, 0.8, 0]}", -sink, 5e-5, 0.2));
  validate({"closed.block.slide.distance", "block sliding obliquely at 1 m/s on four points: stopping distance", kEq12, "m"},
           std::hypot(end(record, "base.x"), end(record, "base.y")), law.stops_after(1), 1e-8,
           "the speed wrong by at most 8e-6 m/s for the last 1.3 ms (row slide.speed)");
  double speed = 0;
  const Table table(record.trace);
  for (std::size_t row = 0; row < record.trace.rows(); ++row) {
    speed = std::max(
        speed, std::abs(std::hypot(table.at(row, "base.vx"), table.at(row, "base.vy")) - law.speed(1, table.at(row, "t"))));
  }
  validate_below(
      {"closed.block.slide.speed", "block sliding obliquely at 1 m/s on four points: worst speed on the way", kEq12, "m/s"},
      speed, 8e-6, "v'' jumps by (f g)^2 / v_lim at v_lim, inside a step: times (50 us)^2 / 2");
}

TEST_P(Block, CreepsDownASlope) {
  const double a = 0.2;
  const double sink = oracle::standing_sink(1, 9.81 * std::cos(a), 4, 1e4);
  const Recording record =
      run(block(GetParam(), fmt::format(", gravity: [{:.17g}, 0, {:.17g}]}}", 9.81 * std::sin(a), -9.81 * std::cos(a)), -sink,
                1e-4, 0.1));
  validate({"closed.block.creep", "block on a slope of 0.2 rad: speed at which it creeps, v_lim tan(a) / f", kEq12, "m/s"},
           end(record, "base.vx"), oracle::SlidingBlock{0.8, 9.81, 0.01}.creeps(a), 1e-14,
           "0.1 s are 77 time constants; rounding of numbers of 0.003");
}

TEST_P(Block, SinksUntilTheGroundCarriesIt) {
  const Recording record = run(block(GetParam(), "}", 0, 1e-4, 1));
  validate({"closed.block.sink", "block let down on four points: sink m g / (n Kn) after 1 s", kEq12, "m"},
           -end(record, "base.z"), oracle::standing_sink(1, 9.81, 4, 1e4), 1e-15,
           "the swing is gone (exp(-49)); rounding of forces of 10 N over 4e4 N/m");
}

TEST_P(Block, SwingsOnLinearDampers) {
  const oracle::StandingBlock law{1, 4, 1e4, 20};
  const double sink = oracle::standing_sink(1, 9.81, 4, 1e4);
  const Recording record = run(block(GetParam(), "}\ncontact: {damping: 20, damping_exponent: 0}", 1e-4 - sink, 5e-5, 0.08));
  const Table table(record.trace);
  double worst = 0;
  for (std::size_t row = 0; row < record.trace.rows(); ++row)
    worst = std::max(worst, std::abs(table.at(row, "base.z") + sink - law.height(1e-4, table.at(row, "t"))));
  validate_below(
      {"closed.block.decay", "block lifted by 0.1 mm, linear damping (d = 0): worst height of the decaying swing", kEq12, "m"},
      worst, 1e-13, "order 4: (50 us * 200 rad/s)^4 / 100 a radian, 5 radians until it has decayed, times 0.1 mm: 5e-14");
}

TEST_P(Block, BouncesWithWhatDampingLeaves) {
  for (const double speed : {0.02, 0.1, 0.5}) {
    const Recording record =
        run(block(GetParam(), fmt::format(", gravity: [0, 0, 0]}}\ninitial: {{base_velocity: [0, 0, -{}]}}", speed),
                  1e-3 * speed, 1e-5, 0.03));
    validate(
        {"closed.block.bounce", "block hits the ground, k = d = 1, no weight: speed afterwards over speed before", kEq12, ""},
        end(record, "base.vz") / speed, oracle::bounces_with(speed, 1e4, 1e5) / speed, 4e-6,
        "the force's slope jumps inside the steps in which it touches and leaves: n Kn / m * (10 us)^2 / 2 each");
  }
}

}  // namespace
}  // namespace gaitlab::test
