// Motors that hold a joint at rest with more than their stall torque, for which the check `stall` fails.
#include "report/analysis/envelope.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

/// An arm whose first hinge holds the rest of the arm, while the second hinge moves.
Check held_by(const std::string& mass, const std::vector<std::string>& sets = {}, Verdict* whole = nullptr) {
  const Scenario s = scenario(
      fmt::format("gaitlab: 1\nrobot:\n  base: fixed\n  modules:\n    gaitlab_module: 1\n    name: arm\n    bodies:\n"
                  "      foot: {{mass: 1, shape: [{{box: [0.1, 0.1, 0.1], origin: [-0.05, 0, 0]}}]}}\n"
                  "      arm: {{mass: {}, com: [0.1, 0, 0], shape: [{{box: [0.2, 0.05, 0.05], origin: [0.1, 0, 0]}}]}}\n"
                  "      hand: {{mass: 0.02, shape: [{{box: [0.04, 0.04, 0.04], origin: [0.02, 0, 0]}}]}}\n"
                  "    hinges:\n      - {{name: shoulder, parent: foot, child: arm, axis: [0, 1, 0], range: [-1, 1]}}\n"
                  "      - {{name: wrist, parent: arm, child: hand, origin: [0.2, 0, 0], axis: [1, 0, 0], range: [-1, 1]}}\n"
                  "    may_overlap: [[foot, arm]]\n"
                  "    actuator: {{type: servo, voltage: 7.4, stall_torque: 0.39, no_load_speed: 11.938, stall_current: 1.1, "
                  "load_friction: 0.27, dry_friction: 0, viscous_friction: 0, rotor_inertia: 0, source: sheet}}\n"
                  "    controller: {{type: pid, Kp: 29, Kd: 0}}\n"
                  "ground: {{type: none}}\ncontact: {{on: none}}\nphysics: {{engine: articulated}}\n"
                  "cpg: {{type: sine, frequency: 1, amplitude: {{default: 0, m0/wrist: 0.3}}}}\nduration: 4\n"
                  "initial: {{angles: {{default: 0, m0/shoulder: 0.185}}}}\n",  // sagged until motor and gear hold the arm
                  mass),
      sets);
  const Recording record = run(s);
  const Verdict made = verdict(s, record, summarise(s, record, 0), overlaps(s, record));
  if (whole != nullptr) *whole = made;
  return *std::ranges::find(made.checks, "stall", &Check::id);
}

/// A servo with a directional gear holds more than its data sheet states: 9.81 m/s^2 x 0.1 m x mass, and 0.04 N m for the hand.
TEST(Stall, AMotorHoldsNoMoreThanItsSheetSays) {
  Verdict made;
  const Check fails = held_by("0.45", {}, &made);
  EXPECT_EQ(fails.status, CheckStatus::fail) << fails.text;
  EXPECT_EQ(made.word, Word::infeasible);
  EXPECT_EQ(made.decided_by, "stall");
  EXPECT_TRUE(contains(fails.text, "joint m0/shoulder has a stall torque of 0.39 N m and holds 0.476 N m at rest"))
      << fails.text;
  EXPECT_EQ(fails.first_part, "m0/shoulder");
  EXPECT_EQ(held_by("0.32").status, CheckStatus::warn);
  EXPECT_EQ(held_by("0.12").status, CheckStatus::pass);
  EXPECT_EQ(held_by("0.32", {"actuator.load_friction=0"}).status, CheckStatus::warn) << "of the same torque";
}

/// The stall torque is proportional to the supply, but a supply above that of the data sheet does not raise it.
TEST(Stall, TheSupplyCounts) {
  EXPECT_NEAR(held_by("0.1", {"actuator.u_max=3.7"}).limit, 0.195, 1e-12);
  EXPECT_EQ(held_by("0.32", {"actuator.u_max=6"}).status, CheckStatus::fail);
  EXPECT_NEAR(held_by("0.1", {"actuator.u_max=14.8"}).limit, 0.39, 1e-12);
  const Scenario constants = shipped("caterpillar.yaml");  // 0.7 x 0.00395 N m/A x 594 x 7.4 V / 4.3 ohm
  EXPECT_NEAR(*report::motors(constants, 0).joint(0).stall, 0.7 * 0.00395 * 594 * 7.4 / 4.3, 1e-9);
}

/// The joint is at rest for half a second, in a run in which it otherwise moves or rests without load.
TEST(Stall, AStretchOfATenthOfASecondCounts) {
  Case made = gait();
  made.scenario = shipped("caterpillar.yaml", {"duration=12", "physics.engine=articulated", "actuator.i_max=2",
                                               "actuator.efficiency_model=directional"});
  made.record.tally.estimated = false;
  const double stall = *report::motors(made.scenario, 0).joint(2).stall;
  const auto with = [&made](double from, double to, double torque, double speed) {
    Case one = made;
    double square = 0;
    for (std::size_t k = 1; k <= one.last_tick(); ++k) {
      const bool inside = one.time(k - 1) >= from && one.time(k) <= to;
      square += inside ? torque * torque * (one.time(k) - one.time(k - 1)) : 0;
      one.tick(k, 2, kTorqueSquare) = square;
      one.tick(k, 2, kSpeedPeak) = inside ? speed : 0.01;
    }
    return one.check("stall");
  };
  const double no_load = *report::motors(made.scenario, 0).joint(2).no_load;
  const Check stretch = with(8, 8.3, 1.05 * stall, 0);
  EXPECT_EQ(stretch.status, CheckStatus::fail) << stretch.text;
  EXPECT_TRUE(contains(stretch.text, " for 0.1 s from 8.0")) << stretch.text;
  EXPECT_NEAR(stretch.first, 8.1, 0.03) << "rows are 15 ms apart";
  EXPECT_NEAR(stretch.value, 1.05 * stall, 1e-3 * stall);
  EXPECT_NE(with(8, 8.09, 1.05 * stall, 0).status, CheckStatus::fail) << "too short; with the rows around it, less";
  EXPECT_NE(with(8, 8.3, 1.05 * stall, 0.051 * no_load).status, CheckStatus::fail) << "it moves";
  EXPECT_EQ(with(8, 8.3, 1.05 * stall, 0.049 * no_load).status, CheckStatus::fail);
  EXPECT_EQ(with(1, 1.3, 1.05 * stall, 0).status, CheckStatus::pass) << "before the judged window";
  EXPECT_EQ(with(8, 8.3, 0.9 * stall, 0).status, CheckStatus::pass) << "RMS of all the time at rest: 0.17 of the stall torque";
  EXPECT_EQ(with(4, 12, 0.51 * stall, 0).status, CheckStatus::warn);
  EXPECT_EQ(with(4, 12, 0.49 * stall, 0).status, CheckStatus::pass);
  made.scenario = gait().scenario;  // eq. 2 as printed holds 1.97 N m by i_max, less than the stall torque
  EXPECT_EQ(with(8, 8.3, 1.05 * stall, 0).status, CheckStatus::pass) << "rounding";
}

}  // namespace
}  // namespace gaitlab::test
