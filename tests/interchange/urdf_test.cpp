// The exported URDF, read by urdfdom, contains the masses, inertias, joint origins and limits of the robot.
#include "interchange/urdf.h"

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "core/dynamics/body_tree.h"
#include "interchange/mjcf.h"
#include "interchange/robot_xml.h"
#include "tests/program/fixture.h"
#include "tests/program/random_scenario.h"
#include "tests/program/rod.h"
#include "tests/validation.h"

namespace gaitlab::test {

using namespace interchange;

namespace {

// Rounding errors of a chain of up to 30 poses with rotations by roll, pitch and yaw, some 1e-16 each.
constexpr double kUrdfRounding = 1e-13;

Pose pose(const urdf::Pose& p) {
  const urdf::Rotation& r = p.rotation;
  return {Quat(r.w, r.x, r.y, r.z).toRotationMatrix(), {p.position.x, p.position.y, p.position.z}};
}

/// Pose of a URDF link in the frame of the root link, with all joints at 0.
Pose frame(const urdf::Link& link) {
  if (link.parent_joint == nullptr) return {};
  return frame(*link.getParent()) * pose(link.parent_joint->parent_to_joint_origin_transform);
}

double difference(const Pose& a, const Pose& b) { return (a.R - b.R).cwiseAbs().maxCoeff() + (a.p - b.p).norm(); }

TEST(Urdf, HasOurMassesInertiasAndJointOrigins) {
  RandomRobots random(31);
  double worst = 0;
  for (int i = 0; i < 30; ++i) {
    Scenario s = random_scenario(random, Base::floating);
    add_motors(random, s);
    const auto& motors = *static_cast<const actuators::DcMotorActuator::Settings*>(s.actuator.settings.get());
    const Robot& robot = *s.robot;
    const auto model = urdf::parseURDF(to_urdf(s));
    ASSERT_NE(model, nullptr);
    EXPECT_EQ(model->links_.size(), robot.bodies.size());
    EXPECT_EQ(model->joints_.size(), robot.joints.size() + robot.modules.size() - 1);
    const Kinematics k = at_zero(robot);
    for (const Body& body : robot.bodies) {
      const urdf::LinkConstSharedPtr link = model->getLink(body.name);
      ASSERT_NE(link, nullptr) << body.name;
      const BodyType& type = robot.types[robot.modules[body.module].type].bodies[body.type];
      if (!(type.mass > 0)) {
        EXPECT_EQ(link->inertial, nullptr);
        continue;
      }
      const urdf::Inertial& in = *link->inertial;
      EXPECT_EQ(in.mass, type.mass);
      Mat3 I;
      I << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
      const Mat3 upper = type.inertia.selfadjointView<Eigen::Upper>();
      EXPECT_EQ(I, upper) << body.name;
      const Pose com = Pose{k.R[body.link], k.p[body.link]} * body.in_link * Pose{Mat3::Identity(), type.com};
      worst = std::max(worst, difference(frame(*link) * pose(in.origin), com));
    }
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const Joint& joint = robot.joints[j];
      const urdf::Joint& read = *model->getJoint(joint.name);
      const urdf::Link& child = *model->getLink(read.child_link_name);
      worst = std::max(worst, difference(frame(child), {k.R[joint.link], k.p[joint.link]}));
      EXPECT_EQ(Vec3(read.axis.x, read.axis.y, read.axis.z), robot.links[joint.link].axis);
      EXPECT_EQ(read.limits->lower, joint.lo);
      EXPECT_EQ(read.limits->upper, joint.hi);
      const double back_emf = motors.Ks[j] * motors.gear[j];
      EXPECT_NEAR(read.limits->velocity, motors.u_max[j] / back_emf, 1e-13 * read.limits->velocity) << joint.name;
      const double current = std::min(motors.i_max[j], motors.u_max[j] / motors.R[j]);
      EXPECT_NEAR(read.limits->effort, motors.efficiency[j] * motors.Kt[j] * motors.gear[j] * current,
                  1e-13 * read.limits->effort)
          << joint.name;
    }
  }
  validate_below({"format.urdf",
                  "exported URDF read back, 30 random assemblies: turn and place of every hinge and centre of mass; "
                  "masses, inertias, axes and limits are exact",
                  "urdfdom", "m"},
                 worst, kUrdfRounding, "chains of up to 30 poses by roll, pitch, yaw: some 1e-16 each");
}

/// All scenarios of the library are exported, with masses, hinges without stops, and different motors.
TEST(Urdf, HoldsTheWholeLibrary) {
  for (const Scenario& s : shipped_library()) {
    const auto model = urdf::parseURDF(to_urdf(s));
    ASSERT_NE(model, nullptr) << s.name;
    double mass = 0;
    for (const auto& [name, link] : model->links_) mass += link->inertial == nullptr ? 0 : link->inertial->mass;
    EXPECT_NEAR(mass, s.robot->mass, 1e-12 * s.robot->mass) << s.name;
    const Kinematics k = at_zero(*s.robot);
    for (const Joint& joint : s.robot->joints) {
      const urdf::Joint& read = *model->getJoint(joint.name);
      EXPECT_EQ(read.type == urdf::Joint::CONTINUOUS, joint.turns_freely()) << s.name << ' ' << joint.name;
      EXPECT_LT(difference(frame(*model->getLink(read.child_link_name)), {k.R[joint.link], k.p[joint.link]}), kUrdfRounding)
          << s.name << ' ' << joint.name;
    }
  }
}

TEST(Urdf, HoldsTheHexapodsMotorsAndContactElements) {
  const auto model = urdf::parseURDF(to_urdf(shipped("hexapod.yaml")));
  ASSERT_NE(model, nullptr);
  const urdf::Joint& joint = *model->getJoint("m3/passive");
  EXPECT_EQ(joint.type, urdf::Joint::REVOLUTE);
  EXPECT_DOUBLE_EQ(joint.limits->effort, 0.7 * 0.00395 * 594 * 1.2);  // eta Kt n i_max
  EXPECT_NEAR(joint.limits->velocity, 7.4 / (0.00395 * 594), 1e-14);  // u_max / (Ks n)
  EXPECT_EQ(model->getJoint("m1/dock")->type, urdf::Joint::FIXED);
  std::size_t collisions = 0;
  for (const auto& [name, link] : model->links_) collisions += link->collision_array.size();
  EXPECT_EQ(collisions, 24U);
  EXPECT_EQ(model->getRoot()->name, "m0/active");
}

TEST(Urdf, SaysWhatItLeavesOut) {
  const std::string urdf = to_urdf(scenario(R"(
gaitlab: 1
robot: {modules: mtran, build: robots/caterpillar-8.dat, base: floating}
initial: {speeds: {default: 0.25, m2/passive: -2}, base_velocity: [0.125, 0.5, 0], base_angular_velocity: [0, 0, 0.75]}
actuator: {rotor_inertia: {m1/active: 1e-8, m3/passive: 2e-8}}
duration: 1
)"));
  for (const char* words : {"velocity 0.125 0.5 0, angular velocity 0 0 0.75", "speeds 0.25 0.25 0.25 0.25 0.25 -2 0.25",
                            " on m1/active, ", " on m3/passive."})
    EXPECT_NE(urdf.find(words), std::string::npos) << words << urdf.substr(0, 1500);
}

/// URDF contains no infinite number. A joint without a torque limit has the large limit that the comment states, or no limit.
TEST(Urdf, TorqueWithoutLimit) {
  const auto drive = [](const std::string& actuator) {
    return scenario("gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 1\nactuator: " + actuator + "\n");
  };
  const Scenario free = drive("{type: torque}\ncontroller: {type: pid, unit: N m}");
  const Scenario none = drive("{type: none}");
  const Scenario held = drive("{type: torque, limit: 0.5}\ncontroller: {type: pid, unit: N m}");
  const auto limits = [](const Scenario& s) { return *urdf::parseURDF(to_urdf(s))->getJoint("m1/passive")->limits; };
  EXPECT_EQ(limits(free).effort, 1e6);
  EXPECT_EQ(limits(held).effort, 0.5);
  EXPECT_EQ(limits(none).effort, 0);
  for (const Scenario* s : {&free, &none, &held}) {
    EXPECT_EQ(limits(*s).velocity, 1e6);
    EXPECT_NE(to_urdf(*s).find("of 1000000 stands for no limit"), std::string::npos);
    EXPECT_EQ(to_urdf(*s).find("inf"), std::string::npos);
    EXPECT_EQ(to_mjcf(*s, MjcfModel::strict).find("\"inf"), std::string::npos);
  }
  EXPECT_NE(to_mjcf(free, MjcfModel::strict).find("ctrllimited=\"false\""), std::string::npos);
  EXPECT_NE(to_mjcf(held, MjcfModel::strict).find("ctrlrange=\"-0.5 0.5\""), std::string::npos);
  EXPECT_EQ(to_mjcf(none, MjcfModel::strict).find("<motor"), std::string::npos);
}

TEST(Urdf, StandsAsTheScenarioWhereTheBaseIsHeld) {
  RandomRobots random(32);
  for (const Base base : {Base::fixed, Base::planar}) {
    const Scenario s = random_scenario(random, base);
    const auto model = urdf::parseURDF(to_urdf(s));
    ASSERT_NE(model, nullptr);
    EXPECT_EQ(model->getRoot()->name, "world");
    const urdf::Joint& joint = *model->getJoint("base");
    EXPECT_EQ(joint.type, base == Base::fixed ? urdf::Joint::FIXED : urdf::Joint::PLANAR);
    EXPECT_LT(difference(pose(joint.parent_to_joint_origin_transform), {rpy(s.orientation), s.position}), kUrdfRounding);
  }
}

/// Conversion to roll, pitch, yaw and back preserves rotations at and near a pitch of 90 degrees, where roll and yaw are not
/// unique.
TEST(Urdf, RollPitchYawIsExactAtTheTop) {
  RandomRobots random(33);
  for (int i = 0; i < 200; ++i) {
    const double off = i % 4 == 0 ? 0 : std::pow(10.0, -(i % 17));
    const double pitch = (i % 2 == 0 ? 1 : -1) * (std::numbers::pi / 2 - off);
    const Mat3 R = rpy({random.uniform(-3, 3), pitch, random.uniform(-3, 3)});
    EXPECT_LT((rpy(to_rpy(R)) - R).cwiseAbs().maxCoeff(), 1e-15 * 5) << i;  // some rounding errors
  }
}

/// Torque at rest of a motor with 2 N m and 8 rad/s at 6 V, and its speed without load, under the largest voltage that the
/// controller and the supply let through.
TEST(MotorLimits, AreThoseOfTheLargestDutyAndOfTheSupply) {
  const auto expect = [](const std::string& keys, double volts) {
    const Scenario s = scenario(rod() +
                                "ground: {type: none}\ncontact: {on: none}\nduration: 1\nactuator: {type: servo, voltage: 6, "
                                "stall_torque: 2, no_load_speed: 8, load_friction: 0, dry_friction: 0, viscous_friction: 0}\n" +
                                keys);
    const auto model = urdf::parseURDF(to_urdf(s));
    const urdf::JointLimits& limits = *model->getJoint("m0/swing")->limits;
    EXPECT_NEAR(limits.effort, 2 * std::min(1.0, volts / 6), 1e-12) << keys;  // at most the stall torque of the sheet
    EXPECT_NEAR(limits.velocity, 8 * volts / 6, 1e-9) << keys;
    const std::string force = text({-limits.effort, limits.effort});
    EXPECT_NE(to_mjcf(s, MjcfModel::walking).find("forcerange=\"" + force + "\""), std::string::npos) << keys;
    EXPECT_NE(to_mjcf(s, MjcfModel::strict).find("ctrlrange=\"" + force + "\""), std::string::npos) << keys;
  };
  expect("controller: {type: rc_servo}\n", 6);
  expect("controller: {type: rc_servo, limit: 0.4}\n", 2.4);
  expect("controller: {type: rc_servo, limit: 0.4}\nsupply: {voltage: 5}\n", 2);
  expect("controller: {type: pid}\nsupply: {voltage: 5}\n", 5);
  expect("controller: {type: pid}\nsupply: {voltage: 7.5}\n", 7.5);
}

}  // namespace
}  // namespace gaitlab::test
