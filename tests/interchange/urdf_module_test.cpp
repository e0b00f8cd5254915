// Modules from URDF: round trips through our own export, links that fixed joints connect, and everything that is refused.
#include "core/settings/shipped_files.h"
#include "interchange/urdf.h"
#include "tests/interchange/from_urdf.h"
#include "tests/program/random_scenario.h"

// urdfdom keeps links that are joined in a loop alive for ever, which LeakSanitizer must ignore.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier): LeakSanitizer's name
extern "C" const char* __lsan_default_suppressions() { return "leak:liburdfdom"; }  // NOLINT(bugprone-reserved-identifier)

namespace gaitlab::test {
namespace {

using namespace interchange;

/// Masses, centres of mass, inertias, hinges and motors of every shipped module come back to the last digit.
TEST_F(FromUrdf, ShippedModulesComeBack) {
  for (const auto& [name, file] : shipped_files("module")) {
    const std::string start = name == "dog12" ? "initial: {angles: {\"*_knee\": -1}}\n" : "";  // 0 is outside its range
    const Scenario one = scenario("robot: {modules: " + name + "}\n" + start + "contact: {on: none}\nduration: 1\n");
    const ModuleType& type = one.robot->types[0];
    const ModuleType back = module_in(module_of_robot(folder_.write("m.urdf", to_urdf(one)), name));
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
    const ModuleType back = module_in(module_of_robot(folder_.write("m.urdf", to_urdf(s)), "back"));
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
                       "viscous_friction: 0, rotor_inertia: 0, load_friction: 0, source: \"chosen:"))
      << made_.text;
  EXPECT_TRUE(
      contains(made_.text,
               "    actuator: {stall_torque: 1, no_load_speed: 4, dry_friction: 0, viscous_friction: 1, rotor_inertia: 0}\n"))
      << made_.text;
  EXPECT_EQ(notes(), (Texts{"0 Changed: effort and velocity become the ends of a motor's line",
                            "0 Not carried over: 1 element of <transmission>", "0 Not carried over: 2 elements of <gazebo>",
                            "6 Not carried over: the name of joint 'dock', which is dock_2 here",
                            "7 Not carried over: the name of joint 'x y', which is x_y here",
                            "8 Not carried over: a motor of joint 'free', whose effort is 0"}));
}

/// Motors of joints without a limit hold twice the weight of all that they move, at its full lever: T = 2 m g L. The stretched
/// A wheel has its centre of mass on its axis: the lever is the radius of gyration, sqrt(0.02 / 2) = 0.1 m.
/// Pairs of an SRDF file are those of the bodies of its links, each once; fixed links are one body.
TEST_F(FromUrdf, PairsOfSrdfMayOverlap) {
  const std::string robot = urdf_link("a") + urdf_link("cover") + urdf_link("b") + urdf_link("c") +
                            urdf_joint("lid", "fixed", "a", "cover", "") + urdf_joint("ab", "revolute", "a", "b", kLimit) +
                            urdf_joint("bc", "revolute", "b", "c", kLimit);
  const auto with = [&](const std::string& pairs) {
    options_.srdf = folder_.write("r.srdf", "<robot name='r'>\n" + pairs + "</robot>\n");
  };
  with(
      "<group name='arm'/>\n<disable_collisions link1='c' link2='cover' reason='Never'/>\n"
      "<disable_collisions link1='a' link2='c'/><disable_collisions link1='cover' link2='a'/>\n"
      "<!-- <disable_collisions link1='no' link2='a'/> --><disable_collisions link1='b' link2='a' reason='Adjacent'/>\n");
  read_urdf(robot);
  EXPECT_EQ(made_.may_overlap, (std::vector<BodyPair>{{"a", "c"}, {"a", "b"}}));
  with("<disable_collisions link1='b' link2='covr'/>\n<disable_collisions link1='b'/>\n");
  const std::string wrong = refused(robot);
  EXPECT_TRUE(contains(wrong, "r.srdf:2:38: error: link 'covr' is not in ")) << wrong;
  EXPECT_TRUE(contains(wrong, "; did you mean 'cover'?\n")) << wrong;
  EXPECT_TRUE(contains(wrong, "r.srdf:3:1: error: disable_collisions has no link2")) << wrong;
  options_.srdf = folder_.write("r.srdf", "<sdf/>");
  EXPECT_TRUE(contains(refused(robot), "r.srdf: error: is not SRDF; expected an element <robot>")) << refused(robot);
  options_.srdf = folder_ / "none.srdf";
  EXPECT_TRUE(contains(refused(robot), "none.srdf: error: ")) << refused(robot);
}

/// One message lists everything that a module cannot contain, in the order of the file.
TEST_F(FromUrdf, RefusesInOneList) {
  const std::string mesh = "<visual><geometry><mesh filename='a.stl'/></geometry></visual>";
  EXPECT_EQ(refused(urdf_link("a", kInertial + mesh) + urdf_link("b") + urdf_link("c") + urdf_link("d") + urdf_link("e") +
                    urdf_joint("ad", "prismatic", "a", "d", kLimit) + urdf_joint("ac", "floating", "a", "c", "") +
                    urdf_joint("ab", "planar", "a", "b", "") +
                    urdf_joint("ae", "revolute", "a", "e", "<limit lower='-1' upper='1' effort='-1' velocity='-2'/>")),
            "r:2:1: error: link 'a' has the mesh 'a.stl', which is neither beside the URDF file nor in the 4 folders above it; "
            "expected its folder by --meshes, or box, cylinder or sphere as collision\n"
            "r:7:1: error: joint 'ad' is prismatic; a module has hinges; they are fixed at 0 by --lock ad --lock ac --lock ab\n"
            "r:8:1: error: joint 'ac' is floating; a module has hinges\n"
            "r:9:1: error: joint 'ab' is planar; a module has hinges\n"
            "r:10:1: error: joint 'ae' has effort -1; expected the torque at rest, N m, of its motor, not negative\n"
            "r:10:1: error: joint 'ae' has velocity -2; expected the no-load speed, rad/s, of its motor, not negative");
  EXPECT_EQ(refused(urdf_link("a", "")),
            "r:2:1: error: link 'a' has no mass; expected inertial (only a link between two hinges may have none)");
  EXPECT_EQ(refused(urdf_link("a") + urdf_link("b")),
            "r: error: urdfdom: Failed to find root link: Two root links found: [a] and [b]");
}

/// Joints that mimic others are hinges of their own; --lock fixes them, and those that slide, at 0. The finger of 2 kg
/// Moments 0.01, 0.01, 0.0201 miss the triangle rule by 0.5 % of the largest: the smallest becomes the difference of the
/// Moments 0.0098 about (1, -1, 0), 0.0103 about z and 0.0202 about (1, 1, 0): the first becomes 0.0099, so that xx and yy
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
                  module_of_robot(folder_.write("e.urdf", text), "made");
                }).ends_with("e.urdf: error: has no element <robot> or <mujoco>; expected a URDF or MJCF file"))
        << text;
  }
}

TEST_F(FromUrdf, TheLinkWorldIsTheBase) {
  const ModuleType type = read_urdf(urdf_link("world", "") + urdf_link("a") + urdf_joint("f", "floating", "world", "a", ""));
  ASSERT_EQ(type.bodies.size(), 1U);
  EXPECT_EQ(type.bodies[0].name, "a");
  EXPECT_EQ(notes(),
            (Texts{"2 Not carried over: link 'world' and floating joint 'f': the base of a scenario floats by default"}));
}

/// A root without mass is the ground if it is the link `world`, or if all its joints are locked.
TEST_F(FromUrdf, ARootOnTheGround) {
  const std::string box = std::string(kInertial) + "<collision><geometry><box size='1 1 1'/></geometry></collision>";
  const std::string ground =
      "2 Changed: link 'world' is the ground: the module has no contacts, so that new scenario writes base: fixed and no "
      "ground";
  const std::string none = "<inertial><mass value='0'/><inertia ixx='0' iyy='0' izz='0' ixy='0' ixz='0' iyz='0'/></inertial>";
  const std::string links = urdf_link("a", box) + urdf_link("b", box);
  const std::string joint = urdf_joint("j", "revolute", "a", "b", kLimit);
  for (const std::string& inertial : {std::string(), none}) {
    const ModuleType type =
        read_urdf(urdf_link("world", inertial) + links + urdf_joint("f", "fixed", "world", "a", "") + joint);
    EXPECT_EQ(notes().at(1), ground);
    EXPECT_TRUE(type.all.empty());
    EXPECT_EQ(type.bodies.at(0).name, "a") << "the first with mass";
  }
  read_urdf(urdf_link("world", "") + links + urdf_joint("f", "fixed", "world", "a", "") +
            urdf_joint("g", "fixed", "world", "b", ""));
  EXPECT_EQ(notes(), Texts{ground}) << "several";
  read_urdf(urdf_link("map", "") + links + urdf_joint("f", "fixed", "map", "a", "") + joint);
  EXPECT_EQ(notes().size(), 1U) << "another name may be a frame of a robot that moves";
  for (const std::string type : {"prismatic", "floating", "planar"}) {
    for (const std::string root : {"world", "rail"}) {
      const std::string robot = urdf_link(root, "") + links + urdf_joint("p", type, root, "a", kLimit) + joint;
      options_.locked = {};
      if (type != "floating") {
        EXPECT_TRUE(refused(robot).starts_with("r:5:1: error: joint 'p' is " + type)) << refused(robot);
        EXPECT_FALSE(contains(refused(robot), "no mass")) << "--lock is enough";
      }
      options_.locked = {"p"};
      EXPECT_TRUE(read_urdf(robot).all.empty()) << type;
      ASSERT_EQ(notes().size(), 3U) << type;
      EXPECT_TRUE(contains(notes()[1], "is the ground: ")) << notes()[1];
      EXPECT_EQ(notes()[2], "5 Changed: joint 'p' is fixed at 0, as --lock asks");
    }
  }
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
  const std::string kRefused =
      "r:2:1: error: has more than 100 attributes; expected an element of a robot file, which has fewer";
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

/// urdfdom drops links that are joined in a loop, because no path from the root leads to them.
TEST_F(FromUrdf, RefusesALoopBesideTheTree) {
  const std::string robot = urdf_link("a") + urdf_link("b") + urdf_joint("j", "revolute", "a", "b", kLimit) + urdf_link("c");
  EXPECT_EQ(refused(robot + urdf_joint("k", "revolute", "c", "c", kLimit)),
            "r:5:1: error: link 'c' is not connected to the root link 'a'; expected one tree, without loops of joints");
  EXPECT_EQ(
      refused(robot + urdf_link("d") + urdf_joint("k", "revolute", "c", "d", kLimit) +
              urdf_joint("l", "revolute", "d", "c", kLimit)),
      "r:5:1: error: link 'c', like 1 other link, is not connected to the root link 'a'; expected one tree, without loops "
      "of joints");
}

/// These elements are nested so deeply that the parser's stack would overflow.
TEST_F(FromUrdf, RefusesADeepFile) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_EQ(refused(deep), "r: error: has 100001 elements; expected at most 10000");
}

}  // namespace
}  // namespace gaitlab::test
