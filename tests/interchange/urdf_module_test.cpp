// Modules from URDF: round trips through our own export, links that fixed joints connect, and everything that is refused.
#include "interchange/urdf_module.h"

#include <cmath>
#include <numbers>

#include "core/robot_files/module_file.h"
#include "core/settings/shipped_files.h"
#include "interchange/urdf.h"
#include "tests/messages.h"
#include "tests/program/random_scenario.h"

namespace gaitlab::test {
namespace {

using namespace interchange;

ModuleType module_in(const UrdfModule& made) {
  Problems problems;
  const Node document = parse_yaml(made.text, "made.yaml");
  ModuleType type = read_module(document, true, problems);
  problems.raise();
  return type;
}

/// Small files, each with a fault or a habit of public robots (README.md beside them).
const std::string kImports = std::string(source_folder()) + "/tests/data/imports/";

constexpr const char* kInertial =
    "<inertial><mass value='2'/><inertia ixx='0.01' iyy='0.02' izz='0.02' ixy='0' ixz='0' iyz='0'/></inertial>";
constexpr const char* kLimit = "<limit lower='-1' upper='2' effort='5' velocity='3'/>";

std::string urdf_link(const std::string& name, const std::string& content = kInertial) {
  return "<link name='" + name + "'>" + content + "</link>\n";
}
std::string urdf_joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                       const std::string& content) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         content + "</joint>\n";
}

class FromUrdf : public ::testing::Test {
 protected:
  ModuleType read_urdf(const std::string& content) {
    made_ = module_of_urdf(folder_.write("r.urdf", "<robot name='r'>\n" + content + "</robot>\n"), "made", locked_);
    return module_in(made_);
  }
  std::string refused(const std::string& content) {
    std::string text = message_of([&] { read_urdf(content); });
    const std::string place = folder_ / "r.urdf";
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place)) text.replace(at, place.size(), "r");
    return text;
  }
  /// Notes of the module that was read last, as `LINE Changed: TEXT`; line 0 means the whole file.
  std::vector<std::string> notes() const {
    std::vector<std::string> texts;
    for (const UrdfNote& note : made_.notes) texts.push_back(fmt::format("{} {}: {}", note.place.line, note.kind(), note.text));
    return texts;
  }
  std::vector<std::string> locked_;  ///< names and patterns of joints to be fixed
  UrdfModule made_;
  Folder folder_;
};
using Texts = std::vector<std::string>;

const BodyType& body_of(const ModuleType& type, const std::string& name) {
  const auto found = std::ranges::find(type.bodies, name, &BodyType::name);
  if (found == type.bodies.end()) throw std::out_of_range("no body " + name);
  return *found;
}

/// Masses, centres of mass, inertias, hinges and motors of every shipped module come back to the last digit.
TEST_F(FromUrdf, ShippedModulesComeBack) {
  for (const auto& [name, file] : shipped_files("module")) {
    const Scenario one = scenario("robot: {modules: " + name + "}\ncontact: {on: none}\nduration: 1\n");
    const ModuleType& type = one.robot->types[0];
    const ModuleType back = module_in(module_of_urdf(folder_.write("m.urdf", to_urdf(one)), name));
    ASSERT_EQ(back.bodies.size(), type.bodies.size()) << name;
    for (const BodyType& body : type.bodies) {
      const BodyType& other = body_of(back, body.name);
      EXPECT_EQ(other.mass, body.mass) << name << " " << body.name;
      EXPECT_EQ(other.com, body.com) << name << " " << body.name;
      EXPECT_EQ(other.inertia, Mat3(body.inertia.selfadjointView<Eigen::Upper>())) << name << " " << body.name;
      EXPECT_EQ(other.shapes.size(), body.shapes.size()) << name << " " << body.name;
    }
    ASSERT_EQ(back.hinges.size(), type.hinges.size()) << name;
    for (const HingeType& hinge : type.hinges) {
      const HingeType& other = *std::ranges::find(back.hinges, hinge.name, &HingeType::name);
      EXPECT_EQ(back.bodies[other.parent].name, type.bodies[hinge.parent].name) << name << " " << hinge.name;
      EXPECT_EQ(other.lo, hinge.lo) << name << " " << hinge.name;
      EXPECT_EQ(other.hi, hinge.hi) << name << " " << hinge.name;
      EXPECT_EQ(other.passive.has_value(), hinge.passive.has_value()) << name << " " << hinge.name;
      // The tolerance is for rounding errors of a rotation as quaternion, as matrix, and as roll, pitch and yaw.
      EXPECT_LT((other.in_parent.R - hinge.in_parent.R).norm(), 1e-14) << name << " " << hinge.name;
      EXPECT_LT((other.in_parent.p - hinge.in_parent.p).norm(), 1e-15) << name << " " << hinge.name;
      EXPECT_LT((other.axis - hinge.axis).norm(), 1e-15) << name << " " << hinge.name;
    }
  }
}

/// The docks of a robot of several modules are fixed joints, so that the links of the robot become the bodies of a module.
TEST_F(FromUrdf, DockedBodiesAreOne) {
  RandomRobots random(43);
  for (int i = 0; i < 20; ++i) {
    Scenario s = random_scenario(random, Base::floating);
    add_motors(random, s);
    const Robot& robot = *s.robot;
    const ModuleType back = module_in(module_of_urdf(folder_.write("m.urdf", to_urdf(s)), "back"));
    ASSERT_EQ(back.bodies.size(), robot.links.size());
    ASSERT_EQ(back.hinges.size(), robot.joints.size());
    // The first moment and the inertia of a link depend on the order of the sums only by rounding errors.
    std::vector<double> masses, moments, found_masses, found_moments;
    for (const Link& link : robot.links) {
      masses.push_back(link.mass);
      moments.push_back(link.inertia.trace());
    }
    for (const BodyType& body : back.bodies) {
      found_masses.push_back(body.mass);
      found_moments.push_back(body.inertia.trace());
    }
    for (std::vector<double>* list : {&masses, &moments, &found_masses, &found_moments}) std::ranges::sort(*list);
    for (std::size_t l = 0; l < masses.size(); ++l) {
      EXPECT_NEAR(found_masses[l], masses[l], 1e-13 * robot.mass);
      EXPECT_NEAR(found_moments[l], moments[l], 1e-12 * moments.back());
    }
  }
}

/// Two links of 2 kg are 0.2 m apart, and one is turned by a quarter about z. The com is in the middle, and I = I1 + R I2 R^T +
/// 2 m d^2 across.
TEST_F(FromUrdf, FixedJointsFuse) {
  const ModuleType type =
      read_urdf(urdf_link("a/base") +
                urdf_link("b/tip", std::string(kInertial) +
                                       "<visual><origin xyz='0.1 0 0'/><geometry><box size='1 2 3'/></geometry></visual>") +
                urdf_joint("weld", "fixed", "a/base", "b/tip", "<origin xyz='0.2 0 0' rpy='0 0 1.5707963267948966'/>"));
  ASSERT_EQ(type.bodies.size(), 1U);
  const BodyType& body = type.bodies[0];
  EXPECT_EQ(body.name, "base");
  EXPECT_EQ(body.mass, 4);
  EXPECT_NEAR(body.com.x(), 0.1, 1e-16);
  EXPECT_NEAR(body.inertia(0, 0), 0.01 + 0.02, 1e-16);
  EXPECT_NEAR(body.inertia(1, 1), 0.02 + 0.01 + 2 * 2 * 0.01, 1e-16);
  EXPECT_NEAR(body.inertia(2, 2), 0.02 + 0.02 + 2 * 2 * 0.01, 1e-16);
  EXPECT_NEAR(body.shapes.at(0).in_body.p.y(), 0.1, 1e-16) << "along x of the turned link";
  EXPECT_EQ(type.all.size(), 8U) << "contacts: {all: shapes}";
}

TEST_F(FromUrdf, MotorsAndPassiveHinges) {
  const std::string robot =
      urdf_link("a") + urdf_link("b") + urdf_link("c") + urdf_link("d") +
      urdf_joint("dock", "revolute", "a", "b", std::string("<axis xyz='0 0 2'/>") + kLimit) +
      urdf_joint("x y", "continuous", "b", "c", "<limit effort='1' velocity='4'/><dynamics damping='1'/>") +
      urdf_joint("free", "continuous", "c", "d", "<limit effort='0' velocity='0'/><dynamics damping='0.1' friction='0.2'/>");
  const ModuleType type = read_urdf(robot + "<transmission name='t'/><gazebo/><gazebo/>");
  ASSERT_EQ(type.hinges.size(), 3U);
  EXPECT_EQ(type.hinges[0].name, "dock_2") << "dock is the name of docks";
  EXPECT_EQ(type.hinges[0].axis, Vec3::UnitZ());
  EXPECT_EQ(type.hinges[0].hi, 2);
  EXPECT_EQ(type.hinges[1].name, "x_y");
  EXPECT_EQ(type.hinges[1].hi, kNoStop);
  ASSERT_TRUE(type.hinges[2].passive);
  EXPECT_EQ(type.hinges[2].passive->damping, 0.1);
  EXPECT_EQ(type.hinges[2].passive->friction, 0.2);
  EXPECT_TRUE(contains(made_.text,
                       "actuator: {type: servo, voltage: 12, stall_torque: 5, no_load_speed: 3, dry_friction: 0, "
                       "viscous_friction: 0, load_friction: 0, rotor_inertia: 0, source: \"chosen:"))
      << made_.text;
  EXPECT_TRUE(contains(made_.text, "    actuator: {stall_torque: 1, no_load_speed: 4, dry_friction: 0, viscous_friction: 1}\n"))
      << made_.text;
  EXPECT_EQ(notes(), (Texts{"0 Changed: effort and velocity become the ends of a motor's line",
                            "0 Not carried over: 1 element of <transmission>", "0 Not carried over: 2 elements of <gazebo>",
                            "6 Not carried over: the name of joint 'dock', which is dock_2 here",
                            "7 Not carried over: the name of joint 'x y', which is x_y here"}));
}

/// Faults that other readers forgive are repaired, each with a note at its line. The rest of a note is the same in each row.
TEST_F(FromUrdf, ForgivesWhatOthersForgive) {
  const auto shape = [](const std::string& geometry) { return "<collision><geometry>" + geometry + "</geometry></collision>"; };
  const std::string box = shape("<box size='1 1 1'/>");
  const std::string first = "<axis xyz='0 1 0'/>";
  struct Row {
    std::string link, joint, note;  ///< content of link b and of the joint from a to b; expected note
  };
  const Row rows[] = {
      {"<visual><geometry><box size='1 1 1'/></geometry><material><color rgba='1 x'/></material></visual>" + box,
       first + kLimit, "3 Changed: a material has no name"},
      {shape("<box size='1, 1,1'/>"), first + kLimit, "3 Changed: size=\"1, 1,1\" is read as 1 1 1"},
      {shape("<box size='1 1 1'/>").insert(11, "<origin xyz='1 2 3 4'/>"), first + kLimit,
       "3 Changed: xyz=\"1 2 3 4\" is read as 1 2 3"},
      {box, "<axis xyz='0 1 0'/><limit lower='-1.57.' upper='2' effort='5' velocity='3'/>",
       "4 Changed: lower=\"-1.57.\" is read as -1.57"},
      {box, "<limit lower='0' upper='0' effort='5' velocity='3'/>",
       "4 Changed: joint 'j' has the range 0 to 0; it turns freely"},
      {box, "<limit lower='2' upper='-1' effort='5' velocity='3'/>",
       "4 Changed: joint 'j' has the range 2 to -1; it turns freely"},
      {box, first, "4 Changed: joint 'j' has no limit; it turns freely"},
      {box, "<limit lower='-1' upper='1' velocity='3'/>",
       "4 Changed: joint 'j' has no effort of a motor; 3.92 N m at rest is chosen"},
      {box, "<limit lower='-1' upper='1' effort='3'/>",
       "4 Changed: joint 'j' has no velocity of a motor; 20 rad/s without load is chosen"},
      {box, first + "<limit lower='-1 ' upper=' 1' effort='3' velocity='2'/>", ""},
  };
  for (const Row& row : rows) {
    const ModuleType type = read_urdf(urdf_link("a", kInertial + box) + urdf_link("b", kInertial + row.link) +
                                      urdf_joint("j", "revolute", "a", "b", row.joint));
    Texts found = notes();
    std::erase(found, "0 Changed: effort and velocity become the ends of a motor's line");
    ASSERT_EQ(found.empty(), row.note.empty()) << row.note;
    if (!found.empty()) EXPECT_EQ(found[0], row.note);
    EXPECT_EQ(type.bodies.size(), 2U) << row.note;
    EXPECT_EQ(type.hinges[0].hi == kNoStop, row.note.ends_with("freely")) << row.note;
    EXPECT_EQ(body_of(type, "b").shapes.at(0).size, Vec3::Ones()) << row.note;
  }
  read_urdf("<material name='red'><color rgba='1 0 0 1'/></material>\n<material name='red'/>\n" + urdf_link("a"));
  EXPECT_EQ(notes(), Texts{"3 Changed: material 'red' is stated twice"});
}

/// What has two meanings is refused, with urdfdom's message: a decimal comma, a vector of two numbers.
TEST_F(FromUrdf, DoesNotGuessNumbers) {
  for (const std::string origin :
       {"xyz='0,5 1 2'", "xyz='1 2'", "xyz='1,2,3,4'", "xyz='1..0 2 3'", "xyz='1 2 x 3'", "rpy='0,5'"}) {
    EXPECT_TRUE(contains(
        refused(urdf_link("a") + urdf_link("b") + urdf_joint("j", "revolute", "a", "b", "<origin " + origin + "/>" + kLimit)),
        "error: urdfdom: "))
        << origin;
  }
}

/// A capsule is a cylinder with a sphere at each end, which together have its outline.
TEST_F(FromUrdf, ACapsuleIsACylinderWithTwoSpheres) {
  const ModuleType type = read_urdf(urdf_link(
      "a", std::string(kInertial) + "<collision><origin xyz='0 0 1' rpy='1.5707963267948966 0 0'/>"
                                    "<geometry><capsule radius='0.1' length='0.4'></capsule></geometry></collision>"));
  const std::vector<Shape>& shapes = type.bodies.at(0).shapes;
  ASSERT_EQ(shapes.size(), 3U);
  // z of the capsule is -y of the link, or the other way round; both ends are there.
  EXPECT_NEAR(std::abs(shapes[0].in_body.p.y()), 0.2, 1e-15);
  EXPECT_NEAR(shapes[0].in_body.p.y(), -shapes[1].in_body.p.y(), 1e-15);
  EXPECT_EQ(shapes[0].size.x(), 0.1);
  EXPECT_EQ(shapes[2].kind, Shape::Kind::cylinder);
  EXPECT_EQ(shapes[2].size, Vec3(0.1, 0.4, 0));
  EXPECT_NEAR(std::abs((shapes[2].in_body.R * Vec3::UnitY()).y()), 1, 1e-15);
  EXPECT_EQ(notes(), Texts{"2 Changed: link 'a' has a capsule, which URDF lacks: a cylinder with a sphere at each end"});
}

/// Motors of joints without a limit hold twice the weight of all that they move, at its full lever: T = 2 m g L. The stretched
/// chain has its farthest centre of mass at 0.3 + 0.4 m from the first hinge, at 0.5 m from the second.
TEST_F(FromUrdf, MotorsAreChosenWithoutALimit) {
  const std::string far =
      "<inertial><origin xyz='0 0.3 0.4'/><mass value='3'/>"
      "<inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial>";
  read_urdf(
      urdf_link("a") + urdf_link("b") + urdf_link("c", far) + urdf_link("w") + urdf_link("s") +
      urdf_joint("ab", "continuous", "a", "b", "<dynamics damping='0.7'/>") +
      urdf_joint("bc", "revolute", "b", "c", "<origin xyz='0.3 0 0'/><limit lower='-1' upper='1' effort='1e5' velocity='4'/>") +
      urdf_joint("aw", "continuous", "a", "w", "<limit effort='3' velocity='1001'/>") +
      urdf_joint("bw", "continuous", "b", "s", "<limit effort='3' velocity='7'/>"));
  const double first = 2 * 9.81 * (2 + 3 + 2) * 0.8;
  const double second = 2 * 9.81 * 3 * 0.5;
  EXPECT_EQ(notes(),
            (Texts{"0 Changed: effort and velocity become the ends of a motor's line",
                   fmt::format(
                       "7 Changed: joint 'ab' has no limit of a motor; {:.3g} N m at rest and 20 rad/s without load are chosen",
                       first),
                   fmt::format("8 Changed: joint 'bc' has no effort of a motor; {:.3g} N m at rest is chosen", second),
                   "9 Changed: joint 'aw' has no velocity of a motor; 20 rad/s without load is chosen"}));
  EXPECT_TRUE(contains(made_.text, fmt::format("    actuator: {{stall_torque: {:.3g}, no_load_speed: 20, dry_friction: 0, "
                                               "viscous_friction: 0.7, source: \"chosen: the URDF has no limit\"}}\n",
                                               first)))
      << made_.text;
  EXPECT_TRUE(contains(made_.text, "actuator: {type: servo, voltage: 12, stall_torque: 3, no_load_speed: 7,")) << made_.text;
}

/// A wheel has its centre of mass on its axis: the lever is the radius of gyration, sqrt(0.02 / 2) = 0.1 m.
TEST_F(FromUrdf, AWheelWithoutALimit) {
  read_urdf(urdf_link("a") + urdf_link("b") + urdf_joint("j", "continuous", "a", "b", ""));
  EXPECT_TRUE(contains(made_.text, "stall_torque: 3.92, no_load_speed: 20,")) << made_.text;
  EXPECT_TRUE(contains(made_.text, "source: \"chosen: the URDF has no limit; the voltage, because URDF has none\""))
      << made_.text;
}

/// One message lists everything that a module cannot contain, in the order of the file.
TEST_F(FromUrdf, RefusesInOneList) {
  const std::string mesh = "<visual><geometry><mesh filename='a.stl'/></geometry></visual>";
  EXPECT_EQ(
      refused(urdf_link("a", kInertial + mesh) + urdf_link("b") + urdf_link("c") + urdf_link("d") + urdf_link("e") +
              urdf_joint("ad", "prismatic", "a", "d", kLimit) + urdf_joint("ac", "floating", "a", "c", "") +
              urdf_joint("ab", "planar", "a", "b", "") +
              urdf_joint("ae", "revolute", "a", "e", "<limit lower='-1' upper='1' effort='-1' velocity='-2'/>")),
      "r:2:1: error: link 'a' has the mesh 'a.stl'; expected box, cylinder or sphere, at least as collision\n"
      "r:7:1: error: joint 'ad' is prismatic; a module has hinges; they are fixed at 0 by --lock \"ad\" --lock \"ac\" --lock "
      "\"ab\"\n"
      "r:8:1: error: joint 'ac' is floating; a module has hinges\n"
      "r:9:1: error: joint 'ab' is planar; a module has hinges\n"
      "r:10:1: error: joint 'ae' has effort -1; expected the torque at rest, N m, of its motor, not negative\n"
      "r:10:1: error: joint 'ae' has velocity -2; expected the no-load speed, rad/s, of its motor, not negative");
  EXPECT_EQ(refused(urdf_link("a", "")),
            "r:2:1: error: link 'a' has no mass; expected inertial (only a link between two hinges may have none)");
  EXPECT_EQ(refused(urdf_link("a") + urdf_link("b")),
            "r: error: urdfdom: Failed to find root link: Two root links found: [a] and [b]");
}

/// Joints that mimic others are hinges of their own; --lock fixes them, and those that are no hinges, at 0. The finger of 2 kg
/// is then part of the hand, 1 m beyond its origin: m_1 m_2 / (m_1 + m_2) d^2 across.
TEST_F(FromUrdf, LockedJointsAreFixed) {
  const std::string robot =
      urdf_link("arm") + urdf_link("hand") + urdf_link("finger_l") + urdf_link("finger_r") +
      urdf_joint("wrist", "revolute", "arm", "hand", kLimit) +
      urdf_joint("finger_1", "prismatic", "hand", "finger_l", "<origin xyz='0 0 1'/><axis xyz='0 1 0'/>") +
      urdf_joint("finger_2", "revolute", "hand", "finger_r",
                 "<mimic joint='wrist'/><limit lower='-1' upper='1' effort='1' velocity='1'/>");
  EXPECT_EQ(refused(robot),
            "r:7:1: error: joint 'finger_1' is prismatic; a module has hinges; it is fixed at 0 by --lock \"finger_1\"");
  locked_ = {"finger_1"};
  const ModuleType one = read_urdf(robot);
  EXPECT_EQ(one.hinges.size(), 2U);
  EXPECT_EQ(body_of(one, "hand").mass, 4);
  EXPECT_NEAR(body_of(one, "hand").com.z(), 0.5, 1e-16);
  EXPECT_NEAR(body_of(one, "hand").inertia(0, 0), 0.01 + 0.01 + 2.0 * 2 / 4 * 1, 1e-15);
  EXPECT_EQ(notes(), (Texts{"0 Changed: effort and velocity become the ends of a motor's line",
                            "7 Changed: joint 'finger_1' is fixed at 0, as --lock asks",
                            "8 Changed: joint 'finger_2' mimics 'wrist'; it moves independently, or is fixed by --lock "
                            "\"finger_2\""}));
  locked_ = {"finger*"};
  EXPECT_EQ(read_urdf(robot).hinges.size(), 1U);
  locked_ = {"wrists"};
  EXPECT_TRUE(contains(refused(robot), "--lock: error: no joint 'wrists'; did you mean 'wrist'?")) << refused(robot);
}

std::string inertial(double mass, const Vec3& moments, const std::string& more = "ixy='0' ixz='0' iyz='0'") {
  return fmt::format("<inertial><mass value='{}'/><inertia ixx='{}' iyy='{}' izz='{}' {}/></inertial>", mass, moments.x(),
                     moments.y(), moments.z(), more);
}

/// Moments 0.01, 0.01, 0.0201 miss the triangle rule by 0.5 % of the largest: the smallest becomes the difference of the
/// others.
TEST_F(FromUrdf, ASmallestMomentIsRaised) {
  const ModuleType type = read_urdf(urdf_link("a", inertial(2, {0.01, 0.01, 0.0201})));
  EXPECT_NEAR(type.bodies[0].inertia.diagonal().minCoeff(), 0.01, 1e-16);
  EXPECT_NEAR(type.bodies[0].inertia.trace(), 2 * 0.0201, 1e-16);
  EXPECT_EQ(notes(),
            Texts{"2 Changed: no body has the principal moments 0.01, 0.01, 0.0201 kg m^2 of link 'a'; the smallest is "
                  "raised: 0.01, 0.0101, 0.0201 kg m^2"});
}

/// Moments 0.0098 about (1, -1, 0), 0.0103 about z and 0.0202 about (1, 1, 0): the first becomes 0.0099, so that xx and yy
/// become (0.0202 + 0.0099) / 2 and xy (0.0202 - 0.0099) / 2.
TEST_F(FromUrdf, ARaisedMomentKeepsItsAxes) {
  const ModuleType type = read_urdf(urdf_link("a", inertial(2, {0.015, 0.015, 0.0103}, "ixy='0.0052' ixz='0' iyz='0'")));
  const Mat3& I = type.bodies[0].inertia;
  EXPECT_NEAR(I(0, 0), 0.01505, 1e-16);
  EXPECT_NEAR(I(1, 1), 0.01505, 1e-16);
  EXPECT_NEAR(I(2, 2), 0.0103, 1e-16);
  EXPECT_NEAR(I(0, 1), 0.00515, 1e-16);
}

/// Inertias beyond that are those of the shapes: m (b^2 + c^2) / 12 of a box; or of a ball of 1000 kg/m^3.
TEST_F(FromUrdf, ImpossibleInertiasAreThoseOfTheShapes) {
  const std::string box = "<collision><origin xyz='1 2 3'/><geometry><box size='0.1 0.2 0.3'/></geometry></collision>";
  for (const Vec3& moments : {Vec3(1, 1, 4), Vec3(0, 0, 0), Vec3(-1, 2, 2), Vec3(0, 1, 1)}) {
    const BodyType body = read_urdf(urdf_link("a", inertial(6, moments) + box)).bodies[0];
    EXPECT_EQ(body.mass, 6);
    EXPECT_EQ(body.com, Vec3::Zero()) << "stated";
    EXPECT_LT((body.inertia.diagonal() - 0.5 * Vec3(0.04 + 0.09, 0.01 + 0.09, 0.01 + 0.04)).norm(), 1e-15);
    ASSERT_EQ(notes().size(), 1U);
    EXPECT_TRUE(contains(notes()[0], "those of its shapes are taken: 0.025, 0.05, 0.065 kg m^2")) << notes()[0];
  }
  const BodyType ball = read_urdf(urdf_link("a", inertial(6, Vec3::Zero()))).bodies[0];
  const double radius = std::cbrt(6 / (4 * std::numbers::pi / 3 * 1000));
  EXPECT_NEAR(ball.inertia(1, 1), 0.4 * 6 * radius * radius, 1e-15);
}

/// Only the sum of a body's links must be possible.
TEST_F(FromUrdf, AFaultThatTheBodyDoesNotHaveIsKept) {
  const ModuleType type = read_urdf(urdf_link("a", inertial(2, {3, 3, 3})) + urdf_link("b", inertial(1, {1, 1, 3})) +
                                    urdf_joint("w", "fixed", "a", "b", ""));
  EXPECT_EQ(Vec3(type.bodies[0].inertia.diagonal()), Vec3(4, 4, 6));
  EXPECT_EQ(notes(), Texts{});
}

/// Faults that only the reader of module files finds have the place and the name of their link or joint.
TEST_F(FromUrdf, FaultsOfTheModuleHaveTheirPlace) {
  const std::string box = std::string(kInertial) + "<visual><geometry><box size='0.1 -0.1 0.1'/></geometry></visual>";
  const auto joint = [](const std::string& content) { return urdf_joint("j", "revolute", "a", "b", content); };
  EXPECT_EQ(refused(urdf_link("a", box) + "<!-- <link name='b'/> -->\n" + urdf_link("b", box) + joint(kLimit)),
            "r:2:1: error: link 'a': box[1] is -0.1 m; expected more than 0 m\n"
            "r:4:1: error: link 'b': box[1] is -0.1 m; expected more than 0 m");
  EXPECT_EQ(refused(urdf_link("a") + urdf_link("b") + joint(std::string("<axis xyz='0 0 0'/>") + kLimit)),
            "r:4:1: error: joint 'j': axis has length 0; expected a direction");
  EXPECT_EQ(refused("<transmission name='t'><joint name='j'/></transmission>\n" + urdf_link("a") + urdf_link("b") +
                    joint("<limit lower='1' upper='1' effort='5' velocity='3'/>")),
            "r:5:1: error: joint 'j': range is 1 to 1 rad; expected the smaller angle first");
  EXPECT_EQ(refused(urdf_link(
                "a", "<inertial><mass value='-1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>")),
            "r:2:1: error: link 'a' has mass -1 kg; expected more than 0 (only a link between two hinges may have none)");
}

/// One fault is one message, at the link or joint that urdfdom names.
TEST_F(FromUrdf, FaultsOfTheFileHaveTheirPlace) {
  EXPECT_EQ(
      refused(urdf_link("a") + urdf_link("b") + urdf_joint("j", "revolute", "a", "b", "<limit effort='nan' velocity='3'/>")),
      "r:4:1: error: urdfdom: effort value (nan) is not a valid float");
  EXPECT_EQ(refused(urdf_link("a") + urdf_link("a")), "r:3:1: error: urdfdom: link 'a' is not unique.");
  EXPECT_EQ(refused("<xacro:macro name='leg'/>\n"),
            "r:2:1: error: has macros of xacro; expected URDF, as `xacro FILE > ROBOT.urdf` writes it");
  for (const char* const text : {"", " \n", "mass: 1", "<!-- <robot/> -->"}) {
    EXPECT_TRUE(message_of([&] {
                  module_of_urdf(folder_.write("e.urdf", text), "made");
                }).ends_with("e.urdf: error: has no element <robot>; expected a URDF file"))
        << text;
  }
}

TEST_F(FromUrdf, TheLinkWorldIsTheBase) {
  const ModuleType type = read_urdf(urdf_link("world", "") + urdf_link("a") + urdf_joint("f", "floating", "world", "a", ""));
  ASSERT_EQ(type.bodies.size(), 1U);
  EXPECT_EQ(type.bodies[0].name, "a");
  EXPECT_EQ(notes(),
            (Texts{"2 Not carried over: link 'world' and floating joint 'f': the base of a scenario floats by default"}));
  read_urdf(urdf_link("world", "") + urdf_link("a") + urdf_joint("f", "fixed", "world", "a", ""));
  EXPECT_EQ(notes(),
            (Texts{"4 Not carried over: the fixed base of link 'world'; a scenario fixes it with robot: {base: fixed}"}));
}

/// A root without mass that a hinge moves stands still. Its mass of 1 kg has the inertia of its shapes, m (b^2 + c^2) / 12.
TEST_F(FromUrdf, ARootWithoutMassIsAFixedBase) {
  const std::string box = "<collision><geometry><box size='0.1 0.2 0.3'/></geometry></collision>";
  const ModuleType type = read_urdf(urdf_link("stand", box) + urdf_link("arm", kInertial + box) +
                                    urdf_joint("j", "revolute", "stand", "arm", kLimit));
  EXPECT_EQ(body_of(type, "stand").mass, 1);
  EXPECT_NEAR(body_of(type, "stand").inertia(0, 0), (0.04 + 0.09) / 12, 1e-16);
  EXPECT_TRUE(type.all.empty()) << "without contacts, new scenario fixes the base";
  EXPECT_EQ(notes().at(1),
            "2 Changed: link 'stand' has no mass, and a joint moves the rest: the base is fixed, its mass is 1 kg; a scenario "
            "fixes it with robot: {base: fixed}");
  const ModuleType bare =
      read_urdf(urdf_link("stand", "") + urdf_link("arm") + urdf_joint("j", "revolute", "stand", "arm", kLimit));
  EXPECT_NEAR(body_of(bare, "stand").inertia(0, 0), 0.4 * std::pow(3 / (4 * std::numbers::pi * 1000), 2.0 / 3), 1e-15)
      << "a ball of water";
}

/// Frames without mass at the end of the tree move nothing. Their shapes stay, on the link before them.
TEST_F(FromUrdf, FramesWithoutMassAreJoined) {
  const std::string ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
  const ModuleType type =
      read_urdf(urdf_link("a") + urdf_link("b") + urdf_link("tip", "") + urdf_link("end", ball) +
                urdf_joint("ab", "revolute", "a", "b", kLimit) +
                urdf_joint("slide", "prismatic", "b", "tip", std::string("<origin xyz='0 0 1'/>") + kLimit) +
                urdf_joint("turn", "revolute", "tip", "end", std::string("<origin xyz='0 0 1'/>") + kLimit));
  ASSERT_EQ(type.hinges.size(), 1U);
  EXPECT_EQ(body_of(type, "b").shapes.at(0).in_body.p, Vec3(0, 0, 2));
  EXPECT_EQ(notes().at(1), "7 Changed: joint 'slide' moves only link 'tip', which has no mass; it is fixed at 0");
  EXPECT_EQ(notes().at(2), "8 Changed: joint 'turn' moves only link 'end', which has no mass; it is fixed at 0");
}

TEST_F(FromUrdf, NamesThatChangeAreNoted) {
  const ModuleType type = read_urdf(urdf_link("k\u00f6rper"));
  EXPECT_EQ(type.bodies[0].name, "k_rper");
  EXPECT_EQ(notes(), (Texts{"2 Not carried over: the name of link 'k\u00f6rper', which is k_rper here"}));
}

/// Readers of YAML such as PyYAML end a line, and with it a comment, at these characters, or refuse the file (U+FFFE).
TEST_F(FromUrdf, NamesStayWithinTheirComments) {
  for (const std::string mark : {"\u0085", "\u2028", "\u2029", "\ufffe"}) {
    read_urdf(urdf_link("a" + mark + "mass: 3"));
    ASSERT_EQ(made_.notes.size(), 1U);
    EXPECT_EQ(made_.text.find(mark), std::string::npos) << made_.text;
    EXPECT_NE(made_.text.find("# Not carried over, line 2: the name of link 'a\\x"), std::string::npos) << made_.text;
  }
}

/// The parser of urdfdom compares every attribute of an element with all before it. No quote, comment or greater-than sign
/// hides an attribute from the limit.
TEST_F(FromUrdf, RefusesElementsWithManyAttributes) {
  const auto attributes = [](int number) {
    std::string text;
    for (int k = 0; k < number; ++k) text += fmt::format(" a{}='>'", k);
    return text;
  };
  const std::string kRefused = "r:2:1: error: has more than 100 attributes; expected an element of URDF, which has fewer";
  for (const std::string before : {"", "<!-- don't -->", "<![CDATA[']]>", "<?a '?>"}) {
    const std::string text = refused(before + "<link name='a'" + attributes(100) + "/>\n");
    EXPECT_EQ(text.substr(text.find(": error")), kRefused.substr(kRefused.find(": error"))) << before;
    EXPECT_EQ(read_urdf(before + "<link name='a'" + attributes(99) + ">" + kInertial + "</link>\n").bodies.size(), 1U)
        << before;
  }
  EXPECT_EQ(refused("<link name='a'" + attributes(60000) + "/>\n"), kRefused);
}

/// A chain of 40 links, each with two joints to the next, would have 2^40 paths, each with the mass of its links.
TEST_F(FromUrdf, RefusesALinkWithTwoParents) {
  std::string chain = urdf_link("l0");
  for (int k = 0; k < 40; ++k) {
    chain += urdf_link(fmt::format("l{}", k + 1));
    for (const char* const name : {"a", "b"})
      chain += urdf_joint(fmt::format("{}{}", name, k), "fixed", fmt::format("l{}", k), fmt::format("l{}", k + 1), "");
  }
  EXPECT_TRUE(contains(refused(chain), "r:5:1: error: link 'l1' is the child of joints 'a0' and 'b0'; expected one tree\n"));
}

/// These elements are nested so deeply that the parser's stack would overflow.
TEST_F(FromUrdf, RefusesADeepFile) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_EQ(refused(deep), "r: error: has 100001 elements; expected at most 10000");
}

/// A link whose picture is a mesh has its collision shapes; a cylinder is along z in URDF and along y in modules.
TEST_F(FromUrdf, CollisionReplacesMeshes) {
  const ModuleType type = read_urdf(urdf_link(
      "a", std::string(kInertial) + "<visual><geometry><mesh filename='a.stl'/></geometry></visual>"
                                    "<collision><geometry><cylinder radius='0.1' length='0.3'/></geometry></collision>"));
  const Shape& shape = type.bodies.at(0).shapes.at(0);
  EXPECT_EQ(shape.kind, Shape::Kind::cylinder);
  EXPECT_EQ(shape.size, Vec3(0.1, 0.3, 0));
  EXPECT_LT((shape.in_body.R * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_EQ(notes(), (Texts{"2 Not carried over: the visual shapes of link 'a'; those of collision are drawn and touch"}));
}

/// What touches is the collision, not what is drawn: a sphere of 0.02 m within a drawn one of 0.10 m.
TEST_F(FromUrdf, CollisionIsTheContact) {
  const ModuleType type = module_in(made_ = module_of_urdf(kImports + "visual_is_not_contact.urdf", "ball"));
  ASSERT_EQ(body_of(type, "body").shapes.size(), 1U);
  EXPECT_EQ(body_of(type, "body").shapes[0].size.x(), 0.02);
  EXPECT_EQ(notes(), (Texts{"3 Not carried over: the visual shapes of link 'body'; those of collision are drawn and touch"}));
}

TEST_F(FromUrdf, VisualIsTheContactOnlyWithoutCollision) {
  const auto part = [](const std::string& tag, const std::string& shape) {
    return "<" + tag + "><geometry>" + shape + "</geometry></" + tag + ">";
  };
  const std::string mesh = "<mesh filename='a.stl'/>";
  read_urdf(urdf_link("a", kInertial + part("visual", "<sphere radius='0.1'/>")));
  EXPECT_EQ(notes(), Texts{"2 Changed: link 'a' has no collision; its visual shapes are its contact"});
  const ModuleType type =
      read_urdf(urdf_link("a", kInertial + part("visual", "<sphere radius='0.1'/>") + part("collision", mesh)));
  EXPECT_EQ(type.bodies[0].shapes.at(0).kind, Shape::Kind::sphere);
  EXPECT_EQ(notes(), Texts{"2 Changed: link 'a' has meshes as collision; its visual shapes are its contact"});
  const std::string same = "<box size='1 2 3'/>";
  read_urdf(urdf_link("a", kInertial + part("visual", same) + part("collision", same)));
  EXPECT_EQ(notes(), Texts{}) << "equal shapes lose nothing";
}

/// Our own export has the contact elements as collision. Points alone do not replace the shapes.
TEST_F(FromUrdf, PointsOfOurExportAreNotShapes) {
  const Scenario one = scenario("robot: {modules: y1}\ncontact: {on: all}\nduration: 1\n");
  const ModuleType back = module_in(made_ = module_of_urdf(folder_.write("m.urdf", to_urdf(one)), "back"));
  for (const BodyType& body : one.robot->types[0].bodies)
    EXPECT_EQ(body_of(back, body.name).shapes.size(), body.shapes.size()) << body.name;
}

}  // namespace
}  // namespace gaitlab::test
