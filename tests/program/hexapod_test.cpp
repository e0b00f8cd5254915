// Walks of the paper's second robot, the hexapod in its alternating tripod gait, and of a similar robot with eight legs. Bounds
// are generous limits of an upright walk with alternating supporting legs and lifted feet. The statics are closed forms.
#include <algorithm>

#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// These tests simulate whole walks with engine bullet.
const Label kHexapodWalks("Walk.*", "long;unsanitized");

constexpr double kGravity = 9.81;

struct Walked {
  explicit Walked(Scenario s)
      : scenario(std::move(s)), record(run(scenario)), table(record.trace), legs(info(*scenario.robot).legs) {}
  Scenario scenario;
  Recording record;
  Table table;
  std::vector<Leg> legs;
  std::vector<ContactElement> contacts = contact_elements(*scenario.robot, ContactSet::feet);

  [[nodiscard]] double weight() const { return kGravity * scenario.robot->mass; }
  /// Numbers of the contact elements of a leg's foot.
  [[nodiscard]] std::vector<std::size_t> foot(const Leg& leg) const {
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (scenario.robot->bodies[contacts[c].body].module ==
          scenario.robot->bodies[static_cast<std::size_t>(leg.bodies.back())].module)
        found.push_back(c);
    }
    return found;
  }
  [[nodiscard]] double load(double t, const Leg& leg) const {
    double sum = 0;
    for (const std::size_t c : foot(leg)) sum += table(t, fmt::format("contact.{}.fz", c));
    return sum;
  }
  /// For each link, true if the joint moves it.
  [[nodiscard]] std::vector<bool> beyond(std::size_t joint) const {
    const Robot& robot = *scenario.robot;
    std::vector<bool> moved(robot.links.size(), false);
    for (std::size_t i = robot.joints[joint].link; i < robot.links.size(); ++i) {
      moved[i] = i == robot.joints[joint].link || moved[static_cast<std::size_t>(robot.links[i].parent)];
    }
    return moved;
  }
  /// Positions and velocities of the links at the trace tick t.
  [[nodiscard]] Kinematics at(double t) const {
    const auto tick = static_cast<std::size_t>(std::llround(t / scenario.trace.period));
    RobotState state = record.state(*scenario.robot, tick);
    for (std::size_t j = 0; j < state.qd.size(); ++j) state.qd[j] = table(t, fmt::format("joint.{}.speed", j));
    state.velocity = Vec3(table(t, "base.vx"), table(t, "base.vy"), table(t, "base.vz"));
    state.angular_velocity = Vec3(table(t, "base.wx"), table(t, "base.wy"), table(t, "base.wz"));
    Kinematics k(*scenario.robot);
    k.update(*scenario.robot, state);
    return k;
  }
  [[nodiscard]] double lowest(double t, const Leg& leg) const {
    const Kinematics k = at(t);
    double z = 1;
    for (const std::size_t c : foot(leg)) z = std::min(z, k.point(contacts[c].link, contacts[c].centre).z());
    return z;
  }
  /// True if a leg stands in the first half of a cycle. Numbered from the front, every second leg of a side stands, and on the
  /// other side the legs in between.
  [[nodiscard]] bool stands_first(std::size_t leg) const { return (leg / 2 + (legs[leg].side > 0 ? 1 : 0)) % 2 == 0; }
};

// The walks use engine articulated, because bullet takes forty times as long; WalkOfTwoEngines compares the two engines.
const std::string kEngine = "physics.engine=articulated";

const Walked& hexapod() {
  static const Walked walked(shipped("hexapod.yaml", {kEngine, "duration=12"}));
  return walked;
}

void expect_walks(const Walked& w, double travel_a_second) {
  const auto& t = w.table;
  EXPECT_GT(t(12, "com.x") - t(4, "com.x"), 8 * travel_a_second);
  const double standing = t(0, "com.z");
  for (int row = 800; row <= 2400; ++row) {
    const double time = 0.005 * row;
    EXPECT_NEAR(t(time, "com.z"), standing, 0.25 * standing) << time;
    const double qx = t(time, "base.qx");
    const double qy = t(time, "base.qy");
    const double qz = t(time, "base.qz");
    EXPECT_LT(2 * std::hypot(qx, qy), 0.2) << "roll and pitch at " << time;
    EXPECT_LT(2 * std::abs(qz), 0.2) << "heading at " << time;
  }
  // The middle of the swing is in the middle of each half of the 2 s cycle.
  for (int second = 4; second < 12; ++second) {
    const double mid = second + 0.5;
    double carried = 0;
    for (std::size_t leg = 0; leg < w.legs.size(); ++leg) {
      const bool first_half = std::fmod(mid, 2) < 1;
      if (w.stands_first(leg) == first_half) {
        carried += w.load(mid, w.legs[leg]);
      } else {
        EXPECT_GT(w.lowest(mid, w.legs[leg]), 4e-3) << "swing foot of leg " << leg << " at " << mid;
        double mean = 0;
        for (int i = -10; i <= 10; ++i) mean += w.load(mid + 0.005 * i, w.legs[leg]) / 21;
        EXPECT_LT(mean, 1.0) << leg << " at " << mid;
      }
    }
    EXPECT_GT(carried, 0.9 * w.weight()) << mid;
  }
}

TEST(Walk, HexapodWalksUprightOnItsTripods) {
  ASSERT_EQ(hexapod().legs.size(), 6U);
  std::vector<std::int64_t> modules;
  for (const Leg& leg : hexapod().legs) {
    modules.push_back(
        static_cast<std::int64_t>(hexapod().scenario.robot->bodies[static_cast<std::size_t>(leg.bodies[0])].module));
  }
  EXPECT_EQ(modules, (std::vector<std::int64_t>{9, 10, 7, 8, 5, 6}));  // from the front, left before right
  expect_walks(hexapod(), 0.025);                                      // at least 0.5 m in 20 s
}

TEST(Walk, OctopodWalksByTheSameMeasures) { expect_walks(Walked(shipped("octopod.yaml", {kEngine, "duration=12"})), 0.025); }

TEST(Walk, GaitBackwardsInTimeTravelsBack) {
  const Recording back = run(shipped("hexapod.yaml", {kEngine, "duration=6", "cpg.model.reverse=true"}));
  const Table t(back.trace);
  const double forward = hexapod().table(6, "com.x") - hexapod().table(2, "com.x");
  // The tolerance is 10 %, because front and rear of the robot's spine differ.
  EXPECT_NEAR(t(6, "com.x") - t(2, "com.x"), -forward, 0.1 * forward);
}

TEST(Walk, CentralSpineJointCarriesTheBodyAsInFigureFourteen) {
  const Walked& w = hexapod();
  std::vector<double> torque;
  std::size_t negative = 0;
  for (int row = 800; row <= 2400; ++row) {
    const double t = 0.005 * row;
    EXPECT_LT(std::abs(w.table(t, "joint.5.angle")), 0.1);
    torque.push_back(w.table(t, "joint.5.torque"));
    if (torque.back() < 0) ++negative;
  }
  const double sign = 2 * negative > torque.size() ? -1 : 1;
  const double same = sign < 0 ? static_cast<double>(negative) : static_cast<double>(torque.size() - negative);
  EXPECT_GE(same, 0.8 * static_cast<double>(torque.size()));
  // Every half cycle (1 s, 200 rows) has a peak, and the torque between peaks is lower by at least 30 %.
  for (double& x : torque) x *= sign;
  for (std::size_t half = 0; half + 200 <= torque.size(); half += 200) {
    const auto from = torque.begin() + static_cast<std::ptrdiff_t>(half);
    const auto [low, high] = std::minmax_element(from, from + 200);
    EXPECT_GT(*high, 0.2);
    EXPECT_LT(*high, 1.5);
    EXPECT_LT(*low, *high - 0.3 * (*high - std::min(0.0, *low)));
    EXPECT_GT(high - from, 20) << "a peak inside the half cycle, not at its edge";
    EXPECT_LT(high - from, 180);
  }
}

/// Angular momentum about `point` of all links that a joint moves.
Vec3 momentum_beyond(const Walked& w, double t, std::size_t joint, const Vec3& point) {
  const Robot& robot = *w.scenario.robot;
  const Kinematics k = w.at(t);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    if (!w.beyond(joint)[i]) continue;
    const Vec3 com = k.point(i, robot.links[i].com);
    sum += (com - point).cross(robot.links[i].mass * k.velocity(i, com)) +
           k.R[i] * (robot.links[i].inertia * (k.R[i].transpose() * k.omega[i]));
  }
  return sum;
}

TEST(Walk, CentralSpineTorqueBalancesWeightsContactsAndInertia) {
  const Walked w(shipped("hexapod.yaml", {kEngine, "duration=5.52", "trace.period=0.001"}));
  const Robot& robot = *w.scenario.robot;
  constexpr std::size_t kJoint = 5;
  const std::vector<bool> beyond = w.beyond(kJoint);
  const std::size_t moved = robot.joints[kJoint].link;
  for (const double t : {4.507, 5.512}) {  // mid-stance, between two control ticks, where accelerations do not jump
    const Kinematics k = w.at(t);
    const Vec3 axis = k.R[moved] * robot.links[moved].axis;
    const Vec3 hinge = k.p[moved];
    double moment = 0;
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      if (beyond[i])
        moment += axis.dot((k.point(i, robot.links[i].com) - hinge).cross(Vec3(0, 0, -kGravity * robot.links[i].mass)));
    }
    for (std::size_t c = 0; c < w.contacts.size(); ++c) {
      if (!beyond[w.contacts[c].link]) continue;
      const std::string name = fmt::format("contact.{}.", c);
      const Vec3 force(w.table(t, name + "fx"), w.table(t, name + "fy"), w.table(t, name + "fz"));
      moment += axis.dot((k.point(w.contacts[c].link, w.contacts[c].centre) - hinge).cross(force));
    }
    // Time derivative of the angular momentum about the present position of the hinge, by a central difference over two rows.
    const double inertia =
        axis.dot(momentum_beyond(w, t + 0.001, kJoint, hinge) - momentum_beyond(w, t - 0.001, kJoint, hinge)) / 0.002;
    const double torque = w.table(t, "joint.5.torque");
    std::printf("t = %.1f s: joint 5 %.4f N m; weights and contacts %.4f, with inertia %.4f (static alone off by %.1f %%)\n", t,
                torque, -moment, inertia - moment, 100 * std::abs((torque + moment) / moment));
    // The tolerance, 2 % of the joint's peak of 0.4 N m, is for the error of a central difference over 2 ms. The controller
    // excites the motion every 15 ms.
    EXPECT_NEAR(torque, inertia - moment, 0.02 * 0.4) << t;
    // The body accelerates downwards at 0.15 m/s^2. This is 1.5 % of the moments of weights and contacts, whose sum is much
    // smaller.
    EXPECT_NEAR(torque, -moment, 0.15 * std::abs(moment)) << t;
  }
}

}  // namespace
}  // namespace gaitlab::test
