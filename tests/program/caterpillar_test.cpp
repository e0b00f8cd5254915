// Tests of the paper's first robot: travel, torque, energy, statics. The expected numbers are those of section 8 of the model.
// Three methods reproduced them: RK4 at 0.01 ms, Bullet's algorithm at 0.025 ms, and a linearly implicit method at 0.5 ms.
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// Whole walks of bullet.
const Label kCaterpillarWalks("Walk.*", "long;unsanitized");

const Label kLongCaterpillar("Standing.ContactForcesCarryTheWeightAndCurrentsTheStaticTorque", "long");

/// Run of the caterpillar. It uses engine articulated, because bullet takes forty times as long; WalkOfTwoEngines compares the
/// two engines.
Recording walked(int seconds, const std::string& set = "name=caterpillar") {
  return run(shipped("caterpillar.yaml", {"physics.engine=articulated", fmt::format("duration={}", seconds), set}));
}

const Recording& walk() {
  static const Recording record = walked(16);
  return record;
}

double travel(const Recording& record, double from, double to) {
  const Table table(record.trace);
  return table(to, "com.x") - table(from, "com.x");
}

TEST(Walk, CaterpillarTravelsAsThreeMethodsAgree) {
  // The tolerance is 3 %, because the travel of the three methods differs by this amount (0.104 to 0.111 m).
  EXPECT_NEAR(travel(walk(), 8, 12), -0.1087, 0.03 * 0.1087);
  EXPECT_NEAR(travel(walk(), 12, 16), -0.1087, 0.03 * 0.1087);
  EXPECT_NEAR(Table(walk().trace)(16, "com.y"), 0, 1e-9);  // only rounding errors, because the robot is symmetric
}

TEST(Walk, JointSevenMovesAndWorksAsInFigureNine) {
  const Table table(walk().trace);
  double lo = 0, hi = 0, lo_angle = 0, hi_angle = 0;
  double repeat = 0;
  for (int row = 1600; row < 3200; ++row) {
    const double t = 0.005 * row;
    lo = std::min(lo, table(t, "joint.7.torque"));
    hi = std::max(hi, table(t, "joint.7.torque"));
    lo_angle = std::min(lo_angle, table(t, "joint.7.angle"));
    hi_angle = std::max(hi_angle, table(t, "joint.7.angle"));
    if (t < 12) repeat = std::max(repeat, std::abs(table(t + 4, "joint.7.torque") - table(t, "joint.7.torque")));
  }
  EXPECT_NEAR((hi_angle - lo_angle) / 2, 0.594, 0.02 * 0.594);
  EXPECT_NEAR(lo, -0.61, 0.061);  // 10 %, because the torque is statically indeterminate
  EXPECT_NEAR(hi, 0.53, 0.053);
  EXPECT_LT(repeat, 0.2 * std::max(-lo, hi));  // cycles differ, because 4 s is not a multiple of the control period
}

TEST(Walk, MotorsDrawMoreThanTheirCopperLosesOverWholeCycles) {
  // The motion repeats exactly after 12 s, which are 3 cycles and 800 control periods. The stored energy is therefore equal at
  // both ends.
  const Table table(walk().trace);
  double surplus = 0;
  double drawn = 0;
  for (std::size_t j = 0; j < 16; ++j) {
    const std::string joint = "joint." + std::to_string(j) + ".";
    for (int row = 801; row <= 3200; ++row) {
      const double t = 0.005 * row;
      const double i = table(t, joint + "current");
      drawn += 0.005 * table(t, joint + "voltage") * i;
      surplus += 0.005 * (table(t, joint + "voltage") * i - 4.3 * i * i);
    }
  }
  std::printf("over 12 s: %.3f J drawn, %.3f J more than the copper's loss\n", drawn, surplus);
  EXPECT_GE(surplus, 0);
}

TEST(Walk, ReversedLagWalksBack) {
  const Recording back = walked(8, "cpg.phase_lag=-1.2");
  // The tolerance is 1 %. Only the start differs, because a different end of the robot leads; the cycle is the same.
  EXPECT_NEAR(travel(back, 4, 8), -travel(walk(), 4, 8), 0.01 * 0.1087);
}

TEST(Walk, LargerLagsTravelLess) {
  std::vector<double> distance;
  for (const char* lag : {"0.8", "1.6", "2.1"}) {
    distance.push_back(std::abs(travel(walked(8, std::string("cpg.phase_lag=") + lag), 4, 8)));
  }
  EXPECT_GT(distance[0], distance[1]);
  EXPECT_GT(distance[1], distance[2]);
}

/// Eight modules that hold a bent posture on the ground until the motion has decayed.
const Scenario& posture() {
  static const Scenario s = scenario(R"(
gaitlab: 1
robot: {modules: mtran, build: robots/caterpillar-8.dat}
initial: {angles: [0.2, -0.3, 0.4, -0.2, 0.3, -0.4, 0.2, 0.1, -0.3, 0.2, 0.3, -0.2, -0.3, 0.4, -0.1, 0.2]}
contact: {on: all}
duration: 3
trace: {columns: [joint.*, contact.*, body.*, com.*]}
)");
  return s;
}

TEST(Standing, ContactForcesCarryTheWeightAndCurrentsTheStaticTorque) {
  const Recording record = run(posture());
  const Robot& robot = *posture().robot;
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  const auto contacts = contact_elements(robot, ContactSet::all);
  Kinematics k(robot);
  RobotState state;
  for (std::size_t j = 0; j < 16; ++j) {
    state.q.push_back(table.at(last, fmt::format("joint.{}.angle", j)));
    state.qd.push_back(0);
  }
  state.position = record.state(robot, last).position;
  state.orientation = record.state(robot, last).orientation;
  k.update(robot, state);
  std::vector<Vec3> forces;
  Vec3 total = Vec3::Zero();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const std::string name = fmt::format("contact.{}.", c);
    forces.emplace_back(table.at(last, name + "fx"), table.at(last, name + "fy"), table.at(last, name + "fz"));
    total += forces.back();
  }
  const double weight = robot.mass * 9.81;
  EXPECT_NEAR(total.z(), weight, 1e-3 * weight);
  for (std::size_t j = 0; j < 16; ++j) {
    // The torque of the motor balances the moments about the joint's axis of weights and contact forces on one side of the
    // joint.
    const std::size_t moved = robot.joints[j].link;
    std::vector<bool> beyond(robot.links.size(), false);
    double moment = 0;
    for (std::size_t i = moved; i < robot.links.size(); ++i) {
      beyond[i] = i == moved || beyond[static_cast<std::size_t>(robot.links[i].parent)];
      if (!beyond[i]) continue;
      const Vec3 arm = k.point(i, robot.links[i].com) - k.p[moved];
      moment += (k.R[moved] * robot.links[moved].axis).dot(arm.cross(Vec3(0, 0, -9.81 * robot.links[i].mass)));
    }
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (!beyond[contacts[c].link]) continue;
      const Vec3 at = k.point(contacts[c].link, contacts[c].centre) - Vec3(0, 0, contacts[c].radius);
      moment += (k.R[moved] * robot.links[moved].axis).dot((at - k.p[moved]).cross(forces[c]));
    }
    const std::string joint = fmt::format("joint.{}.", j);
    const double torque = table.at(last, joint + "torque");
    // The robot creeps, because friction is regularised. At speeds far below v_lim, the moments of the inertial forces are far
    // below 1e-4 of the moments of the weights.
    EXPECT_NEAR(torque, -moment, 1e-4) << j;
    EXPECT_NEAR(table.at(last, joint + "current") * 0.7 * 0.00395 * 594, torque, 1e-12) << j;
  }
}

}  // namespace
}  // namespace gaitlab::test
