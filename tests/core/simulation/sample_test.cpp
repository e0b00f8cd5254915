// Quantities that follow from the state of one lane: orientations, energies, torques of hinges, boxes and reactions.
#include "core/simulation/sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/laws/hinge_stop.h"
#include "tests/random_robots.h"

namespace gaitlab {
namespace {

/// Returns the boxes and accelerations that the test sets, and stores the arguments of its calls.
class ToldPlant final : public Plant {
 public:
  void bind(Out, Out) override {}
  void advance(In, double) override {}
  [[nodiscard]] StepEffort applied() const override { return {}; }
  void accelerate(std::size_t lane, const RobotState&, In torque, std::span<const BodyWrench> wrenches,
                  Acceleration& out) override {
    asked_lane = lane;
    asked_torque.assign(torque.begin(), torque.end());
    asked_wrenches.assign(wrenches.begin(), wrenches.end());
    out = acceleration;
  }
  void contacts(std::size_t, std::span<ContactSample>) const override {}
  void boxes(std::span<BoxMotion> out) const override {
    for (std::size_t i = 0; i < told.size(); ++i) out[i] = told[i];
  }
  std::vector<BoxMotion> told;
  Acceleration acceleration;
  std::size_t asked_lane = 99;
  std::vector<double> asked_torque;
  std::vector<BodyWrench> asked_wrenches;
};

TEST(Sample, OrientationsOfLinksAreThoseOfTheirAxes) {
  test::RandomRobots random(4);
  for (int k = 0; k < 20; ++k) {
    const Robot robot = random.robot(4);
    Sample sample(robot, 0, 0);
    sample.state = random.state(robot, Base::floating);
    sample.forward_kinematics(robot);
    ASSERT_EQ(sample.orientation.size(), robot.links.size());
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      // The tolerance is for rounding errors of a chain of at most eight products.
      EXPECT_LT((sample.orientation[i].toRotationMatrix() - sample.kinematics.R[i]).norm(), 1e-13) << i;
    }
  }
}

/// The sign of a quaternion does not jump during a whole turn, although it would if the quaternion were computed from a
/// rotation matrix.
TEST(Sample, OrientationsAreContinuousThroughAWholeTurn) {
  test::RandomRobots random(4);
  const Robot robot = random.robot_of(2);
  Sample sample(robot, 0, 0);
  std::vector<Quat> before;
  constexpr int kSteps = 200;
  for (int k = 0; k <= kSteps; ++k) {
    sample.state.q.assign(robot.joints.size(), 4 * 3.2 * k / kSteps);
    sample.state.orientation = turn(Vec3::UnitZ(), 4 * 3.2 * k / kSteps);
    sample.forward_kinematics(robot);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_GT(sample.orientation[i].dot(before[i]), 0.5) << i << " " << k;
    before = sample.orientation;
  }
}

/// Kinetic energy of the bodies by Koenig's theorem, from the types of the modules instead of the fused links; springs and
/// rotors by their laws.
TEST(Sample, EnergyIsThatOfBodiesRotorsAndSprings) {
  test::RandomRobots random(11);
  for (int k = 0; k < 10; ++k) {
    Robot robot = random.robot(3);
    robot.joints[0].passive = Passive{.stiffness = 3, .rest = 0.25};
    Sample sample(robot, 0, 0);
    sample.gravity = Vec3(1, 2, -9);
    sample.state = random.state(robot, Base::floating);
    sample.forward_kinematics(robot);
    const Kinematics& kin = sample.kinematics;
    double expected = 0;
    for (const Body& body : robot.bodies) {
      const BodyType& type = robot.types[robot.modules[body.module].type].bodies[body.type];
      const Pose pose = Pose{kin.R[body.link], kin.p[body.link]} * body.in_link;
      const Vec3 com = pose * type.com;
      const Vec3 turning = pose.R.transpose() * kin.omega[body.link];
      expected += type.mass / 2 * kin.velocity(body.link, com).squaredNorm() + turning.dot(type.inertia * turning) / 2 -
                  type.mass * sample.gravity.dot(com);
    }
    expected += 1.5 * std::pow(sample.state.q[0] - 0.25, 2);
    constexpr std::size_t kLanes = 3;
    constexpr std::size_t kLane = 2;
    std::vector<double> inertia(robot.joints.size() * kLanes, 1e9);  // the huge inertia is that of the other lanes
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      inertia[j * kLanes + kLane] = 0.01 * static_cast<double>(j + 1);
      expected += inertia[j * kLanes + kLane] * std::pow(sample.state.qd[j], 2) / 2;
    }
    // The tolerance is for rounding errors of some hundred products of a few joules.
    EXPECT_NEAR(sample.energy(robot, {inertia, kLanes, kLane}, {0}), expected, 1e-11 * (1 + std::abs(expected)));
  }
}

TEST(Sample, HingesPushBackAndOnlyPassiveOnesHaveSprings) {
  test::RandomRobots random(4);
  Robot robot = random.robot_of(2);
  ASSERT_GE(robot.joints.size(), 4U);
  for (Joint& joint : robot.joints) {
    joint.lo = -1;
    joint.hi = 2;
  }
  robot.joints[3].passive = Passive{.stiffness = 2, .rest = 0.5, .damping = 0.1};
  Sample sample(robot, 0, 0);
  sample.state.q[0] = -1.25;
  sample.state.q[1] = 2.5;
  sample.state.q[3] = 1.5;
  sample.state.qd[3] = -3;
  sample.compute_hinges(robot, {3});
  EXPECT_EQ(sample.stop_torque[0], HingeStop::kStiffness * 0.25);
  EXPECT_EQ(sample.stop_torque[1], -HingeStop::kStiffness * 0.5);
  EXPECT_EQ(sample.stop_torque[2], 0);
  EXPECT_EQ(sample.passive_torque[0], 0);
  EXPECT_DOUBLE_EQ(sample.passive_torque[3], -2 * (1.5 - 0.5) + 0.1 * 3);
}

TEST(Sample, BoxesKeepTheSignOfTheirQuaternions) {
  const Robot robot = test::RandomRobots(4).robot_of(1);
  Sample sample(robot, 0, 0);
  Ground ground;
  ground.shape = Boxes{{.center = {1, 2, 3}, .size = {1, 1, 1}}};
  sample.set_boxes(ground);
  EXPECT_TRUE(sample.boxes.empty()) << "none of them moves";
  Box fixed;
  fixed.center = {1, 2, 3};
  Box light = fixed;
  light.mass = 2;
  ground.shape = Boxes{fixed, light};
  sample.set_boxes(ground);
  ASSERT_EQ(sample.boxes.size(), 2U);
  EXPECT_EQ(sample.boxes[1].position, Vec3(1, 2, 3));
  ToldPlant plant;
  plant.told.resize(2);
  Quat before = sample.boxes[1].orientation;
  for (int k = 1; k <= 100; ++k) {
    const Quat turned = turn(Vec3::UnitX(), 0.1 * k);
    plant.told[1].orientation = turned.w() < 0 ? Quat(-turned.coeffs()) : turned;  // w >= 0, as computed from a rotation matrix
    sample.place_boxes(plant);
    EXPECT_GT(sample.boxes[1].orientation.dot(before), 0.9) << k;
    EXPECT_LT(sample.boxes[1].orientation.angularDistance(turned), 1e-7) << k << ": arc cosine of a rounded 1";
    before = sample.boxes[1].orientation;
  }
}

/// A robot rests under its weight and a force of the ground. The base bears the difference.
TEST(Sample, ReactionsAreOfTheForcesThatAct) {
  test::RandomRobots random(4);
  const Robot robot = random.robot_of(2);
  const std::vector<ContactElement> elements = contact_elements(robot, ContactSet::all);
  ASSERT_GE(elements.size(), 2U);
  Sample sample(robot, elements.size(), 0);
  sample.gravity = Vec3(0, 0, -10);
  sample.forward_kinematics(robot);
  const std::size_t n = robot.joints.size();
  for (std::size_t j = 0; j < n; ++j) {
    sample.torque[j] = 100;
    sample.stop_torque[j] = 20;
    sample.passive_torque[j] = 3 + static_cast<double>(j);
  }
  sample.contacts[1] = {.force = Vec3(1, 2, 3), .fn = 3, .point = Vec3(4, 5, 6)};
  sample.contacts[0] = {.force = Vec3(50, 50, 50), .fn = 0};  // remains from an earlier contact
  ToldPlant plant;
  plant.acceleration.joints.assign(n, 0.0);
  sample.compute_reactions(elements, plant, 7);
  EXPECT_EQ(plant.asked_lane, 7U);
  ASSERT_EQ(plant.asked_torque.size(), n);
  EXPECT_EQ(plant.asked_torque[1], 124);
  ASSERT_EQ(plant.asked_wrenches.size(), 1U) << "one element touches";
  EXPECT_EQ(plant.asked_wrenches[0].body, elements[1].body);
  EXPECT_EQ(plant.asked_wrenches[0].point, Vec3(4, 5, 6));
  const Vec3 bears = sample.reactions.base().force;
  EXPECT_LT((bears - Vec3(-1, -2, -3 + 10 * robot.mass)).norm(), 1e-12 * 10 * robot.mass);
}

}  // namespace
}  // namespace gaitlab
