// The walking model of the exported MJCF in MuJoCo: contacts, motors, a drop, and walks with the set points of gaitlab.
#include <map>

#include "core/plugin/actuator.h"
#include "core/scenario/built_robot.h"
#include "interchange/mjcf_laws.h"
#include "tests/interchange/in_mujoco.h"
#include "tests/labels.h"
#include "tests/program/random_scenario.h"

namespace gaitlab::test {

using namespace interchange;

namespace {

const Label kLongMujocoWalking("MujocoWalking.WalksWithTheRecordedSetPoints", "long");

/// Largest relative difference of A_0 from MuJoCo's own estimate.
double weight_error(const Scenario& s) {
  const InMujoco mujoco(s, MjcfModel::walking);
  const mjModel& m = mujoco.model();
  const InverseWeights ours = inverse_weights(s, motor_limits(s));
  double worst = 0;
  for (std::size_t b = 0; b < s.robot->bodies.size(); ++b) {
    const double theirs = m.body_invweight0[std::ptrdiff_t{2} * mj_name2id(&m, mjOBJ_BODY, s.robot->bodies[b].name.c_str())];
    if (s.base != Base::fixed || s.robot->bodies[b].link > 0) worst = std::max(worst, std::abs(ours.bodies[b] / theirs - 1));
  }
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    worst = std::max(worst, std::abs(ours.joints[j] / m.dof_invweight0[mujoco.dof(j)] - 1));
  }
  return worst;
}

/// A_0 in the parameters of contacts and stops is the estimate that MuJoCo itself computes, for every base.
TEST(MujocoWalking, HasMujocosOwnInverseWeights) {
  double worst = 0;
  for (const Scenario& s : shipped_library()) worst = std::max(worst, weight_error(s));
  RandomRobots random(31);
  for (const Base base : {Base::floating, Base::fixed, Base::planar}) {
    for (int i = 0; i < 4; ++i) {
      Scenario s = random_scenario(random, base);
      add_motors(random, s);
      s.ground.shape = Plane{};
      s.contact.on = ContactSet::all;
      worst = std::max(worst, weight_error(s));
    }
  }
  EXPECT_LT(worst, 1e-9);  // rounding error of 1e-16 times the condition of M, up to 1e6
}

/// Only contact elements and ground touch, with the parameters of the element, and the bottom of a point's sphere is the point.
TEST(MujocoWalking, TouchesTheGroundWithItsContactElements) {
  for (const char* file : {"rubble.yaml", "library/smores-drive.yaml"}) {
    Scenario s = shipped(file, {"contact.on=all"});
    s.position = start_state(s).position - Vec3(0, 0, 1e-3);
    s.on_ground = false;
    InMujoco mujoco(s, MjcfModel::walking);
    const mjModel& m = mujoco.model();
    mj_forward(&m, &mujoco.data());
    std::map<std::string, double> depths;
    for (int c = 0; c < mujoco.data().ncon; ++c) {
      const mjContact& contact = mujoco.data().contact[c];
      const bool ground_first = m.geom_bodyid[contact.geom1] == 0;
      EXPECT_EQ(m.geom_bodyid[ground_first ? contact.geom1 : contact.geom2], 0);
      const int element = ground_first ? contact.geom2 : contact.geom1;
      EXPECT_EQ(contact.friction[0], s.ground.friction);
      EXPECT_EQ(contact.solref[0], m.geom_solref[std::ptrdiff_t{mjNREF} * element]);
      EXPECT_EQ(contact.solimp[0], m.geom_solimp[std::ptrdiff_t{mjNIMP} * element]);
      double& depth = depths[mj_id2name(&m, mjOBJ_GEOM, element)];
      depth = std::max(depth, -contact.dist);
    }
    Kinematics k(*s.robot);
    k.update(*s.robot, start_state(s));
    int touching = 0;
    for (const ContactElement& e : contact_elements(*s.robot, s.contact.on)) {
      const double depth = s.ground.query(k.point(e.link, e.centre), e.radius).penetration;
      if (!(depth > 1e-9)) continue;
      ++touching;
      EXPECT_NEAR(depths[e.name], depth, 1e-13) << e.name;  // rounding of ten rotations and sums of numbers below 1
    }
    EXPECT_GT(touching, 0);
    EXPECT_EQ(depths.size(), static_cast<std::size_t>(touching));
  }
}

/// Start of a scenario above the ground.
Scenario lifted(Scenario s, double height) {
  s.position = start_state(s).position + Vec3(0, 0, height);
  s.on_ground = false;
  return s;
}

/// A robot that is dropped comes to rest at the same height, because contact law and controller have the same static force. The
/// tolerance is 0.6 % of the depth at rest of 0.18 mm; a wrong factor (1 - d) would change the depth by 5 %. For k other than
/// 1, the line through the law at the mean depth differs from the law by the square of the differences in load.
void expect_equal_rest(const Scenario& s, double tolerance) {
  const Recording record = run(s);
  InMujoco mujoco(s, MjcfModel::walking);
  while (mujoco.data().time < s.duration - s.physics.step / 2) mj_step(&mujoco.model(), &mujoco.data());
  mj_forward(&mujoco.model(), &mujoco.data());
  const std::size_t column = record.trace.find("com.z");
  const double drop = record.trace.at(0, column) - record.trace.at(record.trace.rows() - 1, column);
  EXPECT_GT(drop, 2e-3) << s.name;
  EXPECT_NEAR(record.trace.at(0, column) - mujoco.data().subtree_com[2], drop, tolerance) << s.name;
}

TEST(MujocoWalking, ComesToRestAtTheSameHeightAfterADrop) {
  const std::vector<std::string> held{"physics.engine=articulated", "duration=2", "cpg={type: sine, amplitude: 0}",
                                      "trace.columns=[com.*]", "physics.estimate=off"};
  expect_equal_rest(lifted(shipped("hexapod.yaml", held), 2e-3), 1e-6);
  expect_equal_rest(lifted(shipped("library/linkbot-drive.yaml", held), 2e-3), 1e-6);
  std::vector<std::string> hertz = held;
  for (const char* more : {"contact.exponent=1.5", "contact.stiffness=1e6"}) hertz.emplace_back(more);
  expect_equal_rest(lifted(shipped("hexapod.yaml", hertz), 2e-3), 1e-6);
}

TEST(MujocoWalking, RestsOnAStopAtTheSameAngle) {
  Scenario s = shipped("pendulum.yaml", {"duration=40", "physics.step=5e-4", "initial.angles=0.25"});
  Robot robot = *s.robot;
  robot.joints[0].lo = 0.2;
  s.robot = std::make_shared<const Robot>(std::move(robot));
  const Recording record = run(s);
  InMujoco mujoco(s, MjcfModel::walking);
  while (mujoco.data().time < s.duration - s.physics.step / 2) mj_step(&mujoco.model(), &mujoco.data());
  const double ours = end(record, "joint.0.angle");
  EXPECT_LT(ours, 0.19);  // the stop gives way by m g l sin(q) / ks = 0.02 rad
  // The damper, (cs / 2) / (m l^2 / 3) = 0.75 1/s, leaves e^-30 of the swing. The tolerance is for sums of doubles of 0.2 in
  // 8e4 steps.
  EXPECT_NEAR(mujoco.q(0), ours, 1e-9);
}

/// Tests the torque at a constant set-point error and a speed, with the limit.
TEST(MujocoWalking, MotorsHaveTheLawOfTheActuatorBehindTheController) {
  for (const auto& [file, sets] : {std::pair<const char*, std::vector<std::string>>{"hexapod.yaml", {}},
                                   {"library/y1-snake.yaml", {"actuator.load_friction=0"}}}) {
    const Scenario s = shipped(file, sets);
    InMujoco mujoco(s, MjcfModel::walking);
    const std::unique_ptr<Actuator> actuator = make_motors(s);
    const std::size_t joints = s.robot->joints.size();
    const auto* pid = static_cast<const controllers::Pid::Settings*>(s.controller.settings.get());
    RobotState state = start_state(s);
    std::vector<double> command(joints), torque(joints), slope(joints);
    for (const double error : {0.01, -0.02, 10.0}) {
      for (const double speed : {0.0, 0.1}) {
        if (error > 1 && speed > 0) continue;  // the limit of the command has no slope, which MuJoCo lacks
        for (std::size_t j = 0; j < joints; ++j) {
          state.qd[j] = speed;
          command[j] = pid->Kp[j] * error - pid->Kd[j] * speed;
          mujoco.data().ctrl[j] = state.q[j] + error;
        }
        mujoco.set(state, 0, 0, 0);
        actuator->effort(command, state.qd, torque, slope);
        for (std::size_t j = 0; j < joints; ++j) {
          EXPECT_NEAR(mujoco.data().actuator_force[j], torque[j], 1e-12) << error << " rad, " << speed << " rad/s";  // rounding
        }
      }
    }
  }
}

/// The keyframe holds the robot, because its controls are the angles at the start.
TEST(MujocoWalking, StartsWithTheAnglesAsControls) {
  const Scenario s = shipped("caterpillar.yaml", {"initial.angles=0.2"});
  InMujoco mujoco(s, MjcfModel::walking);
  ASSERT_EQ(mujoco.model().nu, 16);
  for (int a = 0; a < 16; ++a) EXPECT_EQ(mujoco.data().ctrl[a], 0.2);
  EXPECT_EQ(mujoco.model().opt.integrator, mjINT_IMPLICIT);
}

/// With the recorded set points as controls, robots travel and load their motors as in gaitlab.
TEST(MujocoWalking, WalksWithTheRecordedSetPoints) {
  const auto compare = [](const Scenario& s) {
    const Recording record = run(s);
    const versus::Walk ours = versus::recorded_walk(record, 1);
    const versus::Walk theirs =
        versus::walk_in_mujoco(to_mjcf(s, MjcfModel::walking), s, record, 1, versus::BetweenTicks::line);
    EXPECT_GT(ours.travel, 0.05) << s.name;
    // The tolerances are chosen. docs/mujoco.md has the measured ratios.
    EXPECT_NEAR(theirs.travel / ours.travel, 1, 0.2) << s.name;
    EXPECT_NEAR(theirs.torque / ours.torque, 1, 0.15) << s.name;
  };
  compare(shipped("hexapod.yaml", {"physics.engine=articulated", "duration=4"}));
  compare(shipped("library/ckbot-worm.yaml", {"duration=4", "trace.columns=[joint.*,com.*]"}));
}

}  // namespace
}  // namespace gaitlab::test
