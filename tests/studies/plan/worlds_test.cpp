// Worlds of a scenario: their settings for every kind of robot and ground, and the runs of robust studies in them.
#include "studies/plan/worlds.h"

#include <gtest/gtest.h>

#include "core/laws/dc_motor.h"
#include "core/scenario/built_robot.h"
#include "core/settings/wording.h"
#include "studies/journal/results.h"
#include "tests/messages.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::World;

/// Two M-TRAN modules on the plane.
std::string robot_of_two(const std::string& lines) {
  return "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
         "cpg: {type: phase_oscillator, frequency: 1}\nduration: 0.02\n" +
         lines;
}

/// A world by its name.
World world(const Scenario& own, const std::string& name) {
  for (const World& one : studies::worlds(own)) {
    if (one.name == name) return one;
  }
  ADD_FAILURE() << "no world " << name;
  return {};
}

/// Names of the worlds that apply.
std::vector<std::string> that_apply(const Scenario& own) {
  std::vector<std::string> names;
  for (const World& one : studies::worlds(own)) {
    if (one.applies) names.push_back(one.name);
  }
  return names;
}

/// The scenario in each of its worlds, which none of them refuses.
std::vector<Scenario> in_each(const std::string& text, const std::vector<std::string>& sets = {}) {
  std::vector<Scenario> all;
  for (const World& one : studies::worlds(scenario(text, sets))) {
    std::vector<std::string> more = sets;
    more.insert(more.end(), one.sets.begin(), one.sets.end());
    all.push_back(scenario(text, more));
    EXPECT_EQ(all.back().seed, one.seed) << one.name;
  }
  return all;
}

std::vector<DcMotor> motors_of(const Scenario& of) {
  const auto actuator = make_motors(of);
  return {actuator->dc_motors(), actuator->dc_motors() + of.robot->joints.size()};
}

const std::vector<std::string> kEnds{"friction -25 %",
                                     "friction +25 %",
                                     "R -5 %",
                                     "R +5 %",
                                     "Kt -5 %",
                                     "Kt +5 %",
                                     "mass -3 %",
                                     "mass +3 %",
                                     "supply -10 %",
                                     "gear friction -50 %",
                                     "gear friction +100 %",
                                     "rotor inertia -50 %",
                                     "rotor inertia +100 %"};
constexpr std::size_t kDrawn = 13;         // position of the first draw
constexpr std::size_t kOfPaperMotor = 16;  // dc_motor states its friction and inertia, or has none
using Sets = std::vector<std::string>;
const std::string kGears = "actuator.efficiency_model=directional";

TEST(Worlds, ChangeOneNumberEach) {
  const Scenario own = scenario(robot_of_two(""));
  const std::vector<World> all = studies::worlds(own);
  ASSERT_EQ(all.size(), studies::kWorlds);
  for (std::size_t k = 0; k < kEnds.size(); ++k) EXPECT_EQ(all[k].name, kEnds[k]);
  EXPECT_EQ(all[0].sets, (Sets{"as_built.foot_friction=0.75", kGears}));
  EXPECT_EQ(all[0].text(), "friction -25 % (0.6)");
  EXPECT_EQ(all[3].sets, (Sets{"as_built.R=1.05", kGears}));
  EXPECT_EQ(all[8].sets, (Sets{"as_built.supply=0.9", kGears}));
  EXPECT_EQ(all[8].text(), "supply -10 % (6.66 V)");
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k].applies, k < 9 || k >= kDrawn) << "no chosen friction";
  EXPECT_EQ(all[10].sets, Sets{kGears});
  EXPECT_EQ(all[kDrawn].sets, (Sets{"tolerances.foot_friction=0.125", "tolerances.R=0.025", "tolerances.Kt=0.025",
                                    "tolerances.mass=0.015", "tolerances.supply=0.05", "seed=2", kGears}));
  EXPECT_EQ(all[19].text(), "draw 7 (seed 8)");
  const std::vector<Scenario> made = in_each(robot_of_two(""));
  const DcMotor drawn = motors_of(own).front();
  constexpr double kRounding = 1e-14;
  for (const Scenario& one : made) EXPECT_GT(motors_of(one).front().jumps, 0);
  EXPECT_NEAR(motors_of(made[2]).front().R, 0.95 * drawn.R, kRounding);
  EXPECT_NEAR(motors_of(made[5]).front().Kt, 1.05 * drawn.Kt, kRounding);
  EXPECT_NEAR(motors_of(made[5]).front().Ks, 1.05 * drawn.Ks, kRounding);
  EXPECT_NEAR(motors_of(made[8]).front().u_max, 0.9 * drawn.u_max, kRounding);
  EXPECT_NEAR(made[7].robot->mass, 1.03 * own.robot->mass, kRounding);
  EXPECT_NE(made[kDrawn].robot->mass, made[kDrawn + 1].robot->mass) << "two draws";
}

TEST(Worlds, OfAServoAreThoseOfItsMotor) {
  const std::string text =
      robot_of_two("actuator: {type: servo, voltage: 6, stall_torque: 1.6, no_load_speed: 5, source: a data sheet}\n");
  const std::vector<Scenario> made = in_each(text);
  const DcMotor drawn = motors_of(scenario(text)).front();
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(motors_of(made[3]).front().R, 1.05 * drawn.R, kRounding * drawn.R);
  EXPECT_NEAR(motors_of(made[8]).front().u_max, 5.4, kRounding);
  EXPECT_GT(motors_of(made[0]).front().jumps, 0);
  EXPECT_EQ(world(scenario(text), "supply -10 %").number, "5.4 V") << "voltage, which is u_max";
  EXPECT_EQ(that_apply(scenario(text)).size(), studies::kWorlds);
}

/// Friction and inertia of a servo are chosen where they are not stated: they are worlds of their own, and are drawn.
TEST(Worlds, OfChosenFriction) {
  const auto servo = [](const std::string& keys) {
    return robot_of_two("actuator: {type: servo, voltage: 6, stall_torque: 1.6, no_load_speed: 5" + keys + "}\n");
  };
  const Scenario own = scenario(servo(""));
  EXPECT_EQ(world(own, "gear friction -50 %").sets, Sets{"as_built.gear_friction=0.5"});
  EXPECT_EQ(world(own, "rotor inertia +100 %").sets, Sets{"actuator.rotor_inertia=" + number_text(2 * (0.03 * 1.6 / 5))});
  EXPECT_EQ(world(own, "rotor inertia -50 %").text(), "rotor inertia -50 % (0.0048 kg m^2)");
  const std::vector<Scenario> made = in_each(servo(""));
  const auto drawn = make_motors(own);
  const auto doubled = make_motors(made[10]);
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(doubled->friction()[0].dry, 2 * 0.03 * 1.6, kRounding);
  EXPECT_NEAR(doubled->friction()[0].viscous, 2 * 0.1 * 1.6 / 5, kRounding);
  EXPECT_NEAR(doubled->dc_motors()[0].load, (1 - 0.3) / (1 + 0.3), kRounding) << "load_friction 0.15, twice";
  EXPECT_EQ(doubled->reflected_inertia()[0], drawn->reflected_inertia()[0]);
  EXPECT_NEAR(make_motors(made[12])->reflected_inertia()[0], 2 * drawn->reflected_inertia()[0], kRounding);
  const double one = make_motors(made[kDrawn])->reflected_inertia()[0];
  EXPECT_NE(one, make_motors(made[kDrawn + 1])->reflected_inertia()[0]) << "drawn";
  EXPECT_NEAR(one / drawn->reflected_inertia()[0], 1, 3 * 0.25) << "a draw is limited to three deviations";
  // A stated inertia is kept, and with it the two worlds go; one chosen friction is enough for the others.
  const Scenario stated = scenario(servo(", rotor_inertia: 0.001, dry_friction: 0.05, viscous_friction: 0.04"));
  EXPECT_FALSE(world(stated, "rotor inertia +100 %").applies);
  EXPECT_TRUE(world(stated, "gear friction +100 %").applies) << "load_friction";
  const Scenario all = scenario(servo(", rotor_inertia: 0, dry_friction: 0.05, viscous_friction: 0.04, load_friction: 0.1"));
  EXPECT_EQ(that_apply(all).size(), kOfPaperMotor);
  const Scenario worm = scenario(servo(", load_friction: 0.6"));
  EXPECT_FALSE(world(worm, "gear friction +100 %").applies) << "a gear that eats 1.2 of the torque does not exist";
}

TEST(Worlds, WithoutMotorsAreEleven) {
  const Scenario passive = shipped("pendulum.yaml");
  EXPECT_EQ(that_apply(passive).size(), 9U) << "mass and draws: neither motors nor a ground";
  EXPECT_EQ(world(passive, "mass -3 %").sets, Sets{"as_built.mass=0.97"});
  const std::string ideal = robot_of_two("actuator: {type: torque, limit: 1}\ncontroller: {type: pid, unit: N m, Kp: 5}\n");
  EXPECT_EQ(that_apply(scenario(ideal)).size(), 11U) << "friction, mass, draws";
  EXPECT_EQ(world(scenario(ideal), "mass +3 %").sets, Sets{"as_built.mass=1.03"});
  EXPECT_EQ(world(scenario(ideal), "draw 1").sets, (Sets{"tolerances.foot_friction=0.125", "tolerances.mass=0.015", "seed=2"}));
  in_each(ideal);
  EXPECT_EQ(that_apply(scenario(robot_of_two("contact: {on: none}\n"))).size(), 14U) << "no friction";
}

/// Each module type has its own motors. All gears become directional, and the numbers of each motor change.
TEST(Worlds, OfSeveralModuleTypes) {
  const Scenario own = shipped("library/revolve-spider.yaml");
  for (const World& one : studies::worlds(own)) {
    const Scenario made = shipped("library/revolve-spider.yaml", one.sets);
    const std::vector<DcMotor> motors = motors_of(made);
    for (std::size_t j = 0; j < motors.size(); ++j) {
      EXPECT_TRUE(!made.robot->joints[j].driven() || motors[j].jumps > 0) << one.name;
    }
  }
}

/// Numbers of `as_built`, stated or drawn, are multiplied. All others stay.
TEST(Worlds, ComposeWithARobotAsBuilt) {
  const std::string stated = robot_of_two("as_built: {mass: {m1: 1.2}, R: {m0/active: 1.1}, supply: 0.8}\n");
  const Scenario own = scenario(stated);
  EXPECT_EQ(world(own, "mass +3 %").sets.front(), "as_built.mass=[1.03, 1.236]");
  EXPECT_EQ(world(own, "supply -10 %").text(), "supply -10 % (5.33 V)");
  const std::vector<Scenario> made = in_each(stated);
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(motors_of(made[3])[0].R, 1.05 * motors_of(own)[0].R, kRounding);
  EXPECT_NEAR(motors_of(made[3])[1].R, 1.05 * motors_of(own)[1].R, kRounding);
  EXPECT_EQ(motors_of(made[0])[0].R, motors_of(own)[0].R) << "friction does not change motors";
  EXPECT_EQ(motors_of(made[kDrawn])[0].R, motors_of(own)[0].R) << "stated numbers are not drawn";
}

/// Worlds are drawn within the scenario's own tolerances, with seven other seeds.
TEST(Worlds, DrawWithinTheScenariosTolerances) {
  const std::string text = robot_of_two("tolerances: {mass: 0.1, dock_angle: 0.01}\nseed: 40\n");
  const Scenario own = scenario(text);
  EXPECT_EQ(world(own, "draw 3").sets, (Sets{"seed=43", kGears}));
  const std::vector<Scenario> made = in_each(text);
  EXPECT_EQ(made[kDrawn + 2].as_built, scenario(text, {"seed=43"}).as_built);
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(made[7].robot->mass, 1.03 * own.robot->mass, kRounding) << "of the robot as drawn by its own seed";
}

/// Bullet's solver has a friction coefficient for each solid, but none for parts of the robot.
TEST(Worlds, UnderBulletsLawChangeTheGround) {
  if (catalog().engine("bullet") == nullptr) GTEST_SKIP() << "without engine bullet";
  const std::string text =
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: bullet}\ncontact: {law: bullet, on: "
      "all}\ncpg: {type: phase_oscillator, frequency: 1}\nduration: 0.02\n"
      "ground: {type: boxes, friction: 0.8, boxes: [{center: [1, 0, 0], size: [0.1, 0.1, 0.1], friction: 0.4}]}\n";
  EXPECT_EQ(world(scenario(text), "friction -25 %").sets,
            (Sets{"ground.friction=" + number_text(0.8 * 0.75), "ground.boxes.0.friction=" + number_text(0.4 * 0.75), kGears}));
  const std::vector<Scenario> made = in_each(text);
  EXPECT_NE(made[kDrawn].ground.friction, made[kDrawn + 1].ground.friction) << "drawn";
  constexpr double kMost = 0.8 * 3 * 0.125;  // a draw is limited to three deviations
  for (std::size_t k = kDrawn; k < made.size(); ++k) {
    EXPECT_NEAR(made[k].ground.friction, 0.8, kMost);
    EXPECT_NEAR(made[k].ground.boxes()[0].friction / made[k].ground.friction, 0.5, 1e-12) << "one draw for all solids";
  }
}

const std::string kRobust = "parameters: {cpg.frequency: {low: 0.5, high: 1.5, count: 2}}\nrobust: true\n";

TEST(Robust, ReplicatesAreTheWorlds) {
  const SmallStudy study(kRobust);
  const studies::Plan& plan = *study.plan;
  ASSERT_EQ(plan.points().runs_of_point(), 1 + kOfPaperMotor);
  EXPECT_EQ(plan.sets(0), Sets{"cpg.frequency=0.5"}) << "nominal";
  std::vector<World> all = studies::worlds(plan.scenario());
  std::erase_if(all, [](const World& one) { return !one.applies; });
  for (std::size_t w = 0; w < all.size(); ++w) {
    Sets expected{"cpg.frequency=1.5"};
    expected.insert(expected.end(), all[w].sets.begin(), all[w].sets.end());
    const std::uint64_t run = plan.points().runs_of_point() + 1 + w;
    EXPECT_EQ(plan.sets(run), expected);
    EXPECT_EQ(plan.row(run).seed, all[w].seed);
  }
  const Sets names = studies::journal_head(plan).worlds;
  ASSERT_EQ(names.size(), all.size());
  for (std::size_t w = 0; w < all.size(); ++w) EXPECT_EQ(names[w], all[w].name);
  EXPECT_TRUE(studies::journal_head(*SmallStudy("parameters: {cpg.frequency: {values: [1, 2]}}\n").plan).worlds.empty());
}

TEST(Robust, WorldsThatDoNotApplyAreLeftOut) {
  const SmallStudy study(kRobust + "set: ['actuator={type: torque, limit: 1}', 'controller={type: pid, unit: N m, Kp: 5}']\n");
  EXPECT_EQ(study.plan->points().runs_of_point(), 12U);
  EXPECT_EQ(study.plan->sets(3).at(1), "as_built.mass=0.97") << "behind two of friction";
}

/// A servo whose losses are chosen has four worlds more.
TEST(Robust, WorldsOfChosenFrictionAreReplicates) {
  const std::string servo = "set: ['actuator={type: servo, voltage: 6, stall_torque: 2, no_load_speed: 5";
  const SmallStudy chosen(kRobust + servo + "}']\n");
  EXPECT_EQ(chosen.plan->points().runs_of_point(), 1 + studies::kWorlds);
  EXPECT_EQ(chosen.plan->sets(10).at(1), "as_built.gear_friction=0.5") << "behind the nine worlds of all motors";
  const SmallStudy stated(kRobust + servo + ", dry_friction: 0, viscous_friction: 0, load_friction: 0, rotor_inertia: 0}']\n");
  EXPECT_EQ(stated.plan->points().runs_of_point(), 1 + kOfPaperMotor);
}

/// The value of `as_built` at the point is multiplied, and a point that the scenario refuses is refused as such.
TEST(Robust, WorldsFollowThePoint) {
  const SmallStudy study("parameters: {as_built.mass: {low: 1, high: 1.1, count: 2}}\nrobust: true\n");
  const std::uint64_t run = study.plan->points().runs_of_point() + 8;
  EXPECT_EQ(study.plan->sets(run).at(1), "as_built.mass=" + number_text(1.1 * 1.03));
  const SmallStudy refused("parameters: {cpg.amplitude: {low: 0.1, high: 100, count: 2}}\nrobust: true\n");
  EXPECT_EQ(refused.plan->sets(refused.plan->points().runs() - 1).size(), 1U);
}

/// A quarter of the runs may break limits, because the constraint is the lower quartile of the least margins.
TEST(Robust, TheLowerQuartileOfTheMarginsDecides) {
  const SmallStudy study(
      "parameters: {cpg.frequency: {low: 0.5, high: 1.5, count: 2}}\nrobust: true\n"
      "guards: none\nobjective: {maximize: margin}\nconstraints: [margin >= 0]\n");
  studies::JournalHead head = studies::journal_head(*study.plan);
  const auto result = [&](const std::vector<double>& margins) {
    std::vector<studies::Brief> runs;
    for (std::size_t r = 0; r < margins.size(); ++r) {
      const studies::Row row = study.done(study.plan->row(r), "margin", margins[r]);
      runs.push_back({r, row.outcome, row.message, row.simulated, row.score, row.verdict});
    }
    return studies::point_result(head, runs);
  };
  std::vector<double> margins;
  for (int k = 0; k < 17; ++k)
    margins.push_back(0.01 * ((k * 5 + 16) % 17) - 0.06);  // 0.10, then the numbers down to -0.06 in some order
  std::vector<double> sorted = margins;
  std::ranges::sort(sorted);
  const double quartile = sorted[4];  // the least of the best 13 of 17
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR(result(margins).score.violation, -quartile / (1 - quartile), kRounding);
  for (double& margin : margins) margin += -quartile;
  EXPECT_TRUE(result(margins).kept()) << "four runs are beyond";
  std::vector<double> nominal = margins;
  std::swap(*nominal.begin(), *std::ranges::min_element(nominal));
  const double least = nominal.front();
  EXPECT_NEAR(result(nominal).score.violation, -least / (1 - least), kRounding) << "the nominal run must stand itself";
  for (double& margin : margins) margin -= 1e-6;
  EXPECT_FALSE(result(margins).kept());
}

/// A world that fails counts as a fall; a nominal run that fails is a failed point, in each scenario.
TEST(Robust, NominalRunsMayNotFail) {
  studies::JournalHead head;
  head.combine = "robust";
  head.quantile = 0.75;
  head.scenarios = {"flat", "rubble"};
  head.replicates = 10;
  head.objectives = {{"speed", true}};
  for (std::uint64_t failing = 0; failing < 10; ++failing) {
    std::vector<studies::Brief> runs;
    for (std::uint64_t r = 0; r < 10; ++r) {
      studies::Brief run{20 + r, r == failing ? "diverged" : "done", "", 1, studies::Score{}, Word::feasible};
      if (r == failing) run.score.reset();
      runs.push_back(run);
    }
    EXPECT_EQ(studies::point_result(head, runs).failed, failing % 5 == 0 ? 1U : 0U) << failing;
  }
}

TEST(Robust, HasNoReplicatesBesides) {
  const std::string said = message_of([] { const SmallStudy study(kRobust + "replicates: {count: 2}\n"); });
  EXPECT_TRUE(contains(
      said, "`robust: true` makes the worlds of a point its replicates, but `replicates` is also given; expected one of them"))
      << said;
}

}  // namespace
}  // namespace gaitlab::test
