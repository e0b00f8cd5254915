// Module geometry, docking and fusion agree with closed forms and with docs/numbers.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/model/kinematics.h"
#include "core/robot_files/module_file.h"
#include "core/scenario/scenario.h"
#include "tests/folders.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

const ModuleType& mtran() {
  static const ModuleType type =
      read_module_file(std::string(gaitlab::test::source_folder()) + "/scenarios/modules/mtran.yaml").type;
  return type;
}

Robot robot_of(const std::vector<std::array<int, 5>>& rows) {
  std::vector<Dock> docks;
  int last = 0;
  for (const auto& r : rows) {
    docks.push_back({r[0], r[1], r[2], r[3], r[4], SourceLocation{"robot.dat", static_cast<int>(docks.size()) + 1, 1}});
    last = std::max({last, r[1], r[3]});
  }
  return assemble({mtran()}, std::vector<std::size_t>(static_cast<std::size_t>(last) + 1, 0), docks);
}

std::string error_of(const std::vector<std::array<int, 5>>& rows) {
  return test::message_of([&] { robot_of(rows); });
}

const std::vector<std::array<int, 5>> kHexapod = {{1, 1, 4, 0, 1}, {1, 2, 4, 1, 3}, {1, 3, 4, 2, 1}, {1, 4, 4, 3, 3},
                                                  {0, 5, 3, 0, 3}, {2, 6, 5, 0, 1}, {0, 7, 3, 2, 3}, {2, 8, 5, 2, 1},
                                                  {0, 9, 3, 4, 3}, {2, 10, 5, 4, 1}};

constexpr double kPoseRounding = 1e-15;  // m; rounding errors of some sums of numbers below 1

void expect_near(const std::array<double, 3>& a, const Vec3& b, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(a[i], b[static_cast<Eigen::Index>(i)], kPoseRounding) << what << " axis " << i;
}

Vec3 column(const ModuleInfo& m, std::size_t axis) {
  const auto at = [&](std::size_t row) { return m.rotation[3 * row + axis]; };
  return {at(0), at(1), at(2)};
}

TEST(Mtran, MassSizeAndInertiaAreThoseOfTheShape) {
  double mass = 0;
  for (const BodyType& body : mtran().bodies) mass += body.mass;
  EXPECT_DOUBLE_EQ(mass, 0.400);
  // Closed forms for a box (b) and a half cylinder (c) of uniform density, relative to the hinge axis.
  const double r = 0.0325;
  const double w = 0.065;
  const double pi = 3.14159265358979323846;
  const double vb = r * w * w;
  const double vc = 0.5 * pi * r * r * w;
  const double mb = 0.16 * vb / (vb + vc);
  const double mc = 0.16 * vc / (vb + vc);
  const double xb = -0.5 * r;
  const double xc = 4 * r / (3 * pi);
  const double com = (mb * xb + mc * xc) / 0.16;
  const double about_y =
      mb * (r * r + w * w) / 12 + mb * (xb - com) * (xb - com) + mc * (r * r / 2 - xc * xc) + mc * (xc - com) * (xc - com);
  const BodyType& active = mtran().bodies[0];
  EXPECT_NEAR(active.com.x(), -0.0325 + com, 1e-17);
  EXPECT_NEAR(active.inertia(1, 1), about_y, 1e-18);
}

TEST(Docking, HexapodStandsAsThePaperDraws) {
  const Robot robot = robot_of(kHexapod);
  EXPECT_EQ(robot.modules.size(), 11U);
  EXPECT_EQ(robot.bodies.size(), 33U);
  EXPECT_EQ(robot.links.size(), 23U);
  EXPECT_EQ(robot.dof(Base::floating), 28);
  EXPECT_NEAR(robot.mass, 4.4, 1e-14);
  const RobotInfo about = info(robot);
  for (int k = 0; k < 5; ++k) {
    const ModuleInfo& m = about.modules[static_cast<std::size_t>(k)];
    expect_near(m.position, {0.13 * k, 0, 0}, "spine " + std::to_string(k));
    EXPECT_NEAR(column(m, 0).x(), 1, kPoseRounding);
    EXPECT_NEAR(std::abs(column(m, 1).z()), k % 2 == 0 ? 0.0 : 1.0, kPoseRounding) << "odd spine modules are turned a quarter";
  }
  const std::array<double, 3> kX{0.0325, 0.2925, 0.5525};
  for (std::size_t leg = 0; leg < 6; ++leg) {
    const ModuleInfo& m = about.modules[5 + leg];
    const std::string name = "leg module " + std::to_string(5 + leg);
    EXPECT_NEAR(m.position[0], kX[leg / 2], kPoseRounding) << name;
    EXPECT_NEAR(m.position[1], leg % 2 == 0 ? 0.065 : -0.065, kPoseRounding) << name;
    EXPECT_NEAR(column(m, 0).z(), -1, kPoseRounding) << name << " points down";
    // A positive hip angle moves the foot to +x, because the cross product of axis and (foot - hip) points to +x.
    const JointInfo& hip = about.joints[static_cast<std::size_t>(m.joints[0])];
    const Vec3 axis(hip.axis[0], hip.axis[1], hip.axis[2]);
    EXPECT_GT(axis.cross(Vec3(0, 0, -1)).x(), 0.99) << name;
  }
}

TEST(Docking, FeetOfTheHexapodAreBelowTheSpine) {
  const Robot robot = robot_of(kHexapod);
  const auto feet = contact_elements(robot, ContactSet::feet);
  ASSERT_EQ(feet.size(), 24U);
  const Kinematics k = at_zero(robot);
  for (const ContactElement& foot : feet) EXPECT_NEAR(k.point(foot.link, foot.centre).z(), -0.0975, kPoseRounding) << foot.name;
  EXPECT_EQ(feet.front().name, "m5/passive/p0");
}

TEST(Docking, CaterpillarHas96Elements) {
  std::vector<std::array<int, 5>> rows;
  for (int k = 1; k < 8; ++k) rows.push_back({1, k, 4, k - 1, 0});
  const Robot robot = robot_of(rows);
  EXPECT_EQ(contact_elements(robot, ContactSet::all).size(), 96U);
  EXPECT_EQ(robot.joints[7].name, "m3/passive");
}

TEST(Docking, HingesTurnTheOtherWayWhereTheModuleIsDockedByItsPassiveBlock) {
  const Robot robot = robot_of({{4, 1, 1, 0, 0}});
  EXPECT_EQ(robot.joints[2].name, "m1/passive");  // order is breadth-first from the reference body, the passive block
  EXPECT_EQ(robot.joints[3].name, "m1/active");
  // A positive angle is a right-hand rotation of the child body about the axis of the file, in the frame of the hinge.
  const JointInfo joint = info(robot).joints[2];
  const ModuleInfo module = info(robot).modules[1];
  EXPECT_NEAR(joint.axis[1], column(module, 1).y(), kPoseRounding);
}

/// A hinge that is turned about by the docking has its spring in the same place: angle, range and rest change their signs
/// together.
TEST(Docking, SpringsTurnWithTheirHinge) {
  ModuleType sprung = mtran();
  for (HingeType& hinge : sprung.hinges) {
    hinge.lo = -0.5;
    hinge.hi = 1;
    hinge.passive = Passive{.stiffness = 2, .rest = 0.25};
  }
  const Robot robot = assemble({sprung}, {0, 0}, {{4, 1, 1, 0, 0, SourceLocation{"robot.dat", 1, 1}}});
  for (std::size_t j = 0; j < 4; ++j) {
    const Joint& joint = robot.joints[j];
    const bool turned = joint.module == 1;  // docked by its passive block, it is built from there
    EXPECT_EQ(joint.passive->rest, turned ? -0.25 : 0.25) << joint.name;
    EXPECT_EQ(joint.lo, turned ? -1 : -0.5) << joint.name;
    EXPECT_EQ(joint.hi, turned ? 0.5 : 1) << joint.name;
  }
}

/// Rows of docks in which module m has the number number[m].
std::vector<std::array<int, 5>> renumbered(std::vector<std::array<int, 5>> rows, const std::vector<int>& number) {
  for (auto& row : rows) {
    for (const std::size_t i : {1U, 3U}) row[i] = number[static_cast<std::size_t>(row[i])];
  }
  return rows;
}

/// Expects equal information for plugins about a robot and about the robot with other numbers of its modules. The numbers must
/// be identical, because sums have the same order of terms.
void expect_same(const RobotInfo& a, const RobotInfo& b, const std::vector<int>& number) {
  ASSERT_EQ(a.modules.size(), b.modules.size());
  ASSERT_EQ(a.joints.size(), b.joints.size());
  const auto in_b = [&](std::int64_t m) { return m < 0 ? m : number[static_cast<std::size_t>(m)]; };
  std::vector<std::int64_t> joint(a.joints.size());
  for (std::size_t m = 0; m < a.modules.size(); ++m) {
    const ModuleInfo& one = a.modules[m];
    const ModuleInfo& other = b.modules[static_cast<std::size_t>(number[m])];
    EXPECT_EQ(other.type, one.type) << m;
    EXPECT_EQ(other.parent, in_b(one.parent)) << m;
    EXPECT_EQ(other.parent_face, one.parent_face) << m;
    EXPECT_EQ(other.normal, one.normal) << m;
    EXPECT_EQ(other.position, one.position) << m;
    EXPECT_EQ(other.rotation, one.rotation) << m;
    EXPECT_EQ(other.feet, one.feet) << m;
    std::vector<std::int64_t> children;
    for (const std::int64_t child : one.children) children.push_back(in_b(child));
    std::sort(children.begin(), children.end());
    EXPECT_EQ(other.children, children) << m;
    ASSERT_EQ(other.joints.size(), one.joints.size()) << m;
    for (std::size_t i = 0; i < one.joints.size(); ++i) joint[static_cast<std::size_t>(one.joints[i])] = other.joints[i];
  }
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    const JointInfo& one = a.joints[j];
    const JointInfo& other = b.joints[static_cast<std::size_t>(joint[j])];
    EXPECT_EQ(other.module, in_b(one.module)) << j;
    EXPECT_EQ(other.parent, one.parent < 0 ? -1 : joint[static_cast<std::size_t>(one.parent)]) << j;
    EXPECT_EQ(other.lo, one.lo) << j;
    EXPECT_EQ(other.hi, one.hi) << j;
    EXPECT_EQ(other.origin, one.origin) << j;
    EXPECT_EQ(other.axis, one.axis) << j;
  }
}

TEST(Docking, AParentMayBeNumberedAboveItsChild) {
  const auto expect_same_under = [](const std::vector<std::array<int, 5>>& rows, const std::vector<int>& number) {
    expect_same(info(robot_of(rows)), info(robot_of(renumbered(rows, number))), number);
  };
  expect_same_under({{1, 1, 4, 0, 0}, {1, 2, 4, 1, 0}}, {0, 2, 1});
  expect_same_under(kHexapod, {0, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1});
  expect_same_under(kHexapod, {0, 7, 2, 9, 4, 1, 6, 3, 8, 5, 10});
}

TEST(Fusion, EqualsTheSumOfTheBodies) {
  const Robot robot = robot_of(kHexapod);
  Kinematics k(robot);
  RobotState state;
  for (std::size_t j = 0; j < 22; ++j) {
    state.q.push_back(0.1 * static_cast<double>(j % 5) - 0.2);
    state.qd.push_back(0.3 * static_cast<double>(j % 4) - 0.5);
  }
  state.angular_velocity = {0.3, -0.2, 0.5};
  state.velocity = {0.1, 0.2, -0.3};
  k.update(robot, state);
  const Sums fused = sums(robot, k, Vec3(0, 0, -9.81));
  // Sums over the bodies, each of which moves with its link.
  double kinetic = 0;
  Vec3 momentum = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
  for (const Body& body : robot.bodies) {
    const BodyType& type = mtran().bodies[body.type];
    const Mat3 R = k.R[body.link] * body.in_link.R;
    const Vec3 com = k.point(body.link, body.in_link * type.com);
    const Vec3 v = k.velocity(body.link, com);
    const Vec3 h = R * type.inertia * R.transpose() * k.omega[body.link];
    kinetic += 0.5 * (type.mass * v.squaredNorm() + k.omega[body.link].dot(h));
    momentum += type.mass * v;
    spin += h + type.mass * com.cross(v);
  }
  EXPECT_NEAR(fused.kinetic, kinetic, 1e-13 * kinetic);
  EXPECT_LT((fused.momentum - momentum).norm(), 1e-13);
  EXPECT_LT((fused.angular_momentum - spin).norm(), 1e-13);
}

TEST(DockingErrors, NameTheRowTheMistakeAndARemedy) {
  EXPECT_EQ(
      error_of({{1, 1, 1, 0, 0}}),
      "robot.dat:1:1: error: wrong gender: face 1 of module 1 and face 1 of module 0 are both active; active docks on passive, "
      "so module 1 could take face 3, 4, 5");
  EXPECT_EQ(error_of({{1, 1, 4, 0, 0}, {0, 2, 4, 0, 0}}),
            "robot.dat:2:1: error: face 4 of module 0 is used twice: a face docks once\n"
            "robot.dat:1:1: note: this face is already docked here");
  EXPECT_EQ(error_of({{1, 1, 4, 0, 0}, {1, 2, 4, 7, 0}}),
            "robot.dat:2:1: error: unknown parent module 7: it is neither module 0 nor the child of a row");
  EXPECT_EQ(error_of({{1, 1, 4, 0, 0}, {1, 2, 4, 1, 0}, {0, 2, 3, 0, 0}}),
            "robot.dat:3:1: error: this dock closes a ring: module 2 and module 0 are already connected by other docks; docks "
            "must form a tree, closed chains are not supported\n"
            "robot.dat:2:1: note: its first parent is given here");
  EXPECT_EQ(error_of({{1, 1, 4, 0, 0}, {1, 2, 4, 3, 0}, {1, 3, 4, 2, 0}}),
            "robot.dat:2:1: error: loop: modules 2 - 3 - 2 are docked in a ring, but none of them to module 0");
  EXPECT_EQ(error_of({{1, 1, 4, 0, 0}, {1, 3, 4, 1, 0}}),
            "robot.dat:2:1: error: gap in the numbering: there is a module 3 but no module 2; modules are numbered 0 to n-1");
  EXPECT_EQ(error_of({{1, 1, 4, 0, 4}}),
            "robot.dat:1:1: error: orientation 4 is not a quarter turn: expected 0, 1, 2 or 3 (times pi/2)");
  EXPECT_EQ(error_of({{9, 1, 4, 0, 0}}),
            "robot.dat:1:1: error: module 1 (mtran) has no face 9: its faces are 0, 1, 2, 3, 4, 5");
  EXPECT_EQ(error_of({{1, 0, 4, 1, 0}, {1, 1, 4, 0, 0}}),
            "robot.dat:1:1: error: module 0 is the root and has no parent: number the root 0, or swap child and parent");
  EXPECT_EQ(error_of({{1, 1, 4, 1, 0}}), "robot.dat:1:1: error: loop: module 1 is docked to itself");
}

TEST(DockingErrors, OverlappingCells) {
  // Side docks bend the row of modules until the last module reaches the cell of the first.
  EXPECT_EQ(error_of({{1, 1, 3, 0, 0}, {1, 2, 5, 1, 0}, {1, 3, 5, 2, 0}, {1, 4, 5, 3, 0}}),
            "robot.dat:4:1: error: overlapping cells: m0/active and m4/active are in the same lattice cell at zero angles");
}

}  // namespace
}  // namespace gaitlab
