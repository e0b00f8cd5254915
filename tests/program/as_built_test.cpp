// Tests of the robot as built: its numbers have the effect of changed drawings, and draws depend on seed and part alone.
#include <cmath>
#include <map>

#include "core/model/docking.h"
#include "core/scenario/resolved.h"
#include "tests/labels.h"
#include "tests/messages.h"
#include "tests/program/as_alone.h"
#include "tests/program/engines.h"

namespace gaitlab::test {
namespace {

const Label kLongAsBuilt("*AsBuiltOf.FactorsActAsOtherDrawings/*", "long");

const std::string kEveryTolerance =
    "tolerances={mass: 0.03, inertia: 0.05, dock_angle: 0.01, foot_friction: 0.1, R: 0.07, Kt: 0.05, gear_friction: 0.1, "
    "supply: 0.02}";
const std::string kTorques = "trace.columns=[joint.*, base.*]";

Scenario built(std::vector<std::string> sets, const std::string& engine = "articulated") {
  sets.insert(sets.begin(), {"physics.engine=" + engine, "duration=0.3", kTorques});
  return shipped("caterpillar.yaml", sets);
}

class AsBuiltOf : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Engine, AsBuiltOf, engines(), engine_name);

// Every pair changes the same numbers in two ways: by as_built, and in the drawings. All factors are powers of 2, which change
// no digit.
TEST_P(AsBuiltOf, FactorsActAsOtherDrawings) {
  const std::map<std::string, std::vector<std::string>> pairs{
      {"as_built.R=2", {"actuator.R=8.6"}},
      {"as_built.Kt=0.5", {"actuator.Kt=0.001975", "actuator.Ks=0.001975"}},
      {"as_built.supply=0.5", {"actuator.u_max=3.7"}},
      {"as_built.R.m3/active=2", {"actuator.R={default: 4.3, m3/active: 8.6}"}},
      {"as_built.foot_friction=0.5", {"ground.friction=0.4"}},
  };
  for (const auto& [factor, drawings] : pairs) {
    EXPECT_EQ(alone(built({factor}, GetParam())), alone(built(drawings, GetParam()))) << factor;
    EXPECT_NE(alone(built({factor}, GetParam())), alone(built({}, GetParam()))) << factor;
  }
}

// The friction that is drawn for a module is that under its contact elements, and acts as another ground.
TEST(AsBuilt, FootFrictionIsThatOfItsModule) {
  const Scenario drawn = built({kEveryTolerance, "seed=3"});
  const PerJoint& friction = drawn.as_built.numbers[5];
  EXPECT_NE(friction[0], friction[1]);
  for (const ContactElement& element : contact_elements(*drawn.robot, ContactSet::all))
    EXPECT_EQ(element.friction, friction[drawn.robot->bodies[element.body].module]) << element.name;
  EXPECT_EQ(alone(built({"as_built.foot_friction=0.5"})), alone(built({"ground.friction=0.4"})));
  EXPECT_NE(alone(built({"as_built={foot_friction: {m3: 0.5}}"})), alone(built({})));
}

// Twice the masses and twice the torque constants give the same motion and twice the torques.
TEST(AsBuilt, MassesScaleTorques) {
  const std::vector<std::string> pushed{"ground.type=none",   "contact.on=none",    "robot.base=fixed",
                                        "actuator.i_max=1e6", "actuator.u_max=1e6", "physics.integrator=rk4",
                                        "physics.step=1e-4"};
  std::vector<std::string> heavy = pushed;
  heavy.insert(heavy.end(), {"as_built.mass=2", "actuator.Kt=0.0079", "actuator.Ks=0.001975"});
  std::vector<std::string> drawn = pushed;
  drawn.insert(drawn.end(), {"actuator.Kt=0.00395", "actuator.Ks=0.001975"});
  const Recording a = run(built(heavy));
  const Recording b = run(built(drawn));
  const Table twice(a.trace);
  const Table once(b.trace);
  for (std::size_t row = 0; row < a.trace.rows(); ++row) {
    for (std::size_t j = 0; j < 16; ++j) {
      ASSERT_EQ(twice.at(row, fmt::format("joint.{}.angle", j)), once.at(row, fmt::format("joint.{}.angle", j))) << row;
      ASSERT_EQ(twice.at(row, fmt::format("joint.{}.torque", j)), 2 * once.at(row, fmt::format("joint.{}.torque", j))) << row;
    }
  }
}

TEST(AsBuilt, NothingLeavesTheSameBytes) {
  const Scenario without = built({});
  for (const char* none :
       {"tolerances={}", "as_built={}", "tolerances={mass: 0, R: 0}", "as_built={mass: 1, R: {m3/active: 1}}"}) {
    const Scenario with = built({none});
    EXPECT_EQ(resolved(with), resolved(without)) << none;
    EXPECT_EQ(alone(with), alone(without)) << none;
  }
}

TEST(AsBuilt, TheResolvedScenarioHoldsTheDraw) {
  const Scenario drawn = built({kEveryTolerance, "seed=7"});
  const std::string text = resolved(drawn);
  const Scenario again = scenario(text);
  EXPECT_EQ(resolved(again), text);
  EXPECT_EQ(alone(again), alone(drawn));
  ASSERT_FALSE(again.notes.empty());
  EXPECT_TRUE(contains(again.notes.back().text, "tolerances has no effect"));
  EXPECT_EQ(alone(scenario(text, {"seed=8"})), alone(drawn));
  EXPECT_EQ(alone(scenario(text, {"seed=8", "as_built={}"})), alone(built({kEveryTolerance, "seed=8"})));
}

TEST(AsBuilt, EverySeedIsAnotherRobotInLanes) {
  std::vector<std::vector<std::string>> own;
  for (int seed = 1; seed <= 8; ++seed) own.push_back({fmt::format("seed={}", seed)});
  const std::vector<Scenario> all = rollouts(
      kScenarios + "caterpillar.yaml",
      {"physics.engine=articulated", "physics.estimate=off", "duration=0.3", kTorques, kEveryTolerance}, own, catalog());
  const std::vector<std::string> expected = expect_as_alone(all, 7);
  for (std::size_t i = 1; i < expected.size(); ++i) EXPECT_NE(expected[i], expected[0]);
}

// A stated number is not drawn, also not from the resolved scenario, even if it is neutral.
TEST(AsBuilt, StatedNeutralNumbersStay) {
  const Scenario stated = built({"tolerances={mass: 0.03}", "as_built={mass: 1}"});
  EXPECT_EQ(stated.as_built, AsBuilt());
  EXPECT_EQ(scenario(resolved(stated)).as_built, AsBuilt());
}

// The largest step of an explicit method follows from the friction of each element.
TEST(AsBuilt, FrictionLimitsTheStep) {
  const auto refusal = [](const std::string& slippery) {
    return message_of([&] {
      const Scenario s = built({"physics.integrator=rk4", "physics.step=2e-5", slippery});
      const Simulation simulation({&s, 1});
    });
  };
  const std::string by_ground = refusal("ground.friction=80");
  EXPECT_TRUE(contains(by_ground, "physics.step")) << by_ground;
  EXPECT_EQ(refusal("as_built.foot_friction=100"), by_ground);
}

// A draw depends on seed and part alone: not on other tolerances, nor on stated numbers, nor on further modules.
TEST(AsBuilt, ADrawDependsOnSeedAndPartAlone) {
  const Scenario all = built({kEveryTolerance});
  const Scenario mass_alone = built({"tolerances={mass: 0.03}"});
  EXPECT_EQ(all.as_built.numbers[0], mass_alone.as_built.numbers[0]);
  const Scenario stated = built({kEveryTolerance, "as_built={mass: {m3: 1.1}}"});
  for (std::size_t m = 0; m < 8; ++m) {
    EXPECT_EQ(stated.as_built.numbers[0][m], m == 3 ? 1.1 : all.as_built.numbers[0][m]) << m;
  }
  EXPECT_EQ(all.as_built.numbers[2][0], 0) << "module 0 has no dock";
}

TEST(AsBuilt, MassesAndInertias) {
  const Scenario drawn = built({});
  const Scenario other = built({"as_built={mass: {m3: 2}, inertia: {m5: 4}}"});
  for (std::size_t b = 0; b < drawn.robot->bodies.size(); ++b) {
    const Body& before = drawn.robot->bodies[b];
    const Body& after = other.robot->bodies[b];
    EXPECT_EQ(after.mass, before.mass * (before.module == 3 ? 2 : 1));
    EXPECT_EQ(after.inertia, Mat3(before.inertia * (before.module == 3 ? 2 : before.module == 5 ? 4 : 1)));
  }
  EXPECT_NEAR(other.robot->mass, drawn.robot->mass * 9 / 8, 1e-12);
}

// The module is turned at the dock by a rotation vector in the axes of the parent's face. The dock stays where it is.
TEST(AsBuilt, DockAngles) {
  const Scenario drawn = built({});
  const auto poses = [](const Scenario& s) {
    std::vector<Pose> all;
    const Kinematics k = at_zero(*s.robot);
    for (const Body& body : s.robot->bodies) {
      all.push_back({k.R[body.link] * body.in_link.R, k.point(body.link, body.in_link.p)});
    }
    return all;
  };
  const Module& child = drawn.robot->modules[1];
  const ModuleType& type = drawn.robot->types[drawn.robot->modules[0].type];
  const FaceType& face = *find_face(type, child.dock.parent_face);
  const std::vector<Pose> before = poses(drawn);
  const Pose& on = before[drawn.robot->modules[0].first_body + face.body];
  const Vec3 dock = on * face.origin;
  Mat3 axes;
  axes << face.normal, face.reference, face.normal.cross(face.reference);
  for (const Vec3& angle : {Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(0, 0, 0.1), Vec3(0.1, -0.2, 0.05)}) {
    const std::vector<Pose> after = poses(built({fmt::format(
        "as_built={{dock_x: {{m1: {}}}, dock_y: {{m1: {}}}, dock_z: {{m1: {}}}}}", angle.x(), angle.y(), angle.z())}));
    const Mat3 R = turn(on.R * axes * angle).toRotationMatrix();
    for (std::size_t b = 0; b < before.size(); ++b) {
      const bool turned = drawn.robot->bodies[b].module >= 1;
      const Mat3 expected = turned ? Mat3(R * before[b].R) : before[b].R;
      const Vec3 place = turned ? Vec3(dock + R * (before[b].p - dock)) : before[b].p;
      EXPECT_LT((after[b].R - expected).norm(), 1e-14) << b;  // rounding error of products of a few rotations
      EXPECT_LT((after[b].p - place).norm(), 1e-14) << b;     // rounding error of products with lengths below 1 m
    }
  }
}

TEST(AsBuilt, WrongInput) {
  const auto wrong = [](const std::string& set, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"duration=1", set});
    const std::string text = message_of([&] { shipped("caterpillar.yaml", more); });
    return text.substr(0, text.find('\n'));
  };
  const std::map<std::string, std::string> messages{
      {"tolerances.mass=0.5", "mass is 0.5; expected 0 to 0.3"},
      {"tolerances.gear_friction=0.6", "gear_friction is 0.6; expected 0 to 0.5"},
      {"tolerances.mass=-0.1", "mass is -0.1; expected 0 to 0.3"},
      {"tolerances.dock_angle=1", "dock_angle is 1 rad; expected 0 to 0.1 rad"},
      {"tolerances.dock_angle=5 deg", "dock_angle is '5 deg'; expected a number in rad"},
      {"tolerances.mas=0.1", "unknown key 'mas'; did you mean 'mass'?"},
      {"tolerances.zero=0.1",
       "unknown key 'zero'; known keys: mass, inertia, dock_angle, foot_friction, R, Kt, gear_friction, play, supply"},
      {"tolerances=0.1", "tolerances is 0.1; expected a map"},
      {"tolerances={R: {m3/active: 0.1}}", "R is a map; expected a number"},
      {"as_built=1", "as_built is 1; expected a map"},
      {"as_built={mass: {m9: 1}}", "no module 'm9'; modules are m0 to m7"},
      {"as_built={mass: {m3/active: 1}}", "'m3/active' is not a module; expected its module, m3"},
      {"as_built={mass: {m1: 0}}", "mass of 'm1' is 0; expected 0.01 to 100"},
      {"as_built={mass: [1, 2]}", "mass has 2 numbers; expected one for each of the robot's 8 modules"},
      {"as_built={mass: heavy}", "mass is 'heavy'; expected a number"},
      {"as_built={R: {m3/activ: 1}}", "no joint 'm3/activ'; did you mean 'm3/active'?"},
      {"as_built={R: {m3: 1}}", "'m3' is a module; its joints are m3/active, m3/passive"},
      {"as_built={dock_x: {m0: 0.1}}", "m0 has no dock_x: it is docked to no parent"},
      {"as_built={dock_x: {m3: 2}}", "dock_x of 'm3' is 2 rad; expected -0.5 to 0.5 rad"},
      {"as_built={supply: {m3: 1}}", "supply is a map; expected a number"},
      {"as_built={foot_friction: {\"m*\": 1, \"*1\": 2}}",
       "module 'm1' is given 1 by 'm*' and 2 by '*1'; give it by its name, which beats patterns"},
      {"as_built={gear_friction: 9}",
       "gear_friction 9 changes the gear efficiency of m0/active from 0.7 to -1.7; expected an efficiency above 0, thus a "
       "factor "
       "below 3.333"},
  };
  for (const auto& [set, text] : messages) EXPECT_TRUE(contains(wrong(set), "error: " + text)) << wrong(set);
  EXPECT_TRUE(contains(wrong("tolerances={Kt: 0.1}", {"actuator={type: torque}", "controller={unit: N m}"}),
                       "tolerances.Kt applies only to dc_motor and servo, but the actuator is 'torque'"));
  EXPECT_TRUE(contains(wrong("tolerances={foot_friction: 0.1}", {"physics.engine=bullet", "contact.law=bullet"}),
                       "tolerances.foot_friction does not apply to contact law 'bullet'"));
}

}  // namespace
}  // namespace gaitlab::test
