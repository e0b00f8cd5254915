// Modules from MJCF: rules of bodies, joints, motors and contact, and everything that is refused.
#include <numbers>

#include "core/model/body_pairs.h"
#include "tests/interchange/from_urdf.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using interchange::RobotNote;

constexpr double kDegree = std::numbers::pi / 180;

class FromMjcf : public ::testing::Test {
 protected:
  ModuleType read_file(const std::string& file) {
    return module_in(made_ = interchange::module_of_robot(file, "made", options_));
  }
  ModuleType read_mjcf(const std::string& content) {
    return read_file(folder_.write("r.xml", "<mujoco>\n" + content + "</mujoco>\n"));
  }
  std::string refused(const std::string& content) {
    std::string text = message_of([&] { read_mjcf(content); });
    const std::string place = folder_ / "r.xml";
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place)) text.replace(at, place.size(), "r");
    return text;
  }
  Texts notes() const {
    Texts texts;
    for (const RobotNote& note : made_.notes)
      texts.push_back(fmt::format("{} {}: {}", note.place.line, note.kind(), note.text));
    return texts;
  }
  interchange::ImportOptions options_;
  interchange::RobotModule made_;
  Folder folder_;
};

/// A body of 1 kg with `content`.
std::string body(const std::string& name, const std::string& content) {
  return "<body name='" + name + "'><inertial pos='0 0 0' mass='1' diaginertia='0.1 0.1 0.1'/>" + content + "</body>\n";
}
std::string world(const std::string& content) { return "<worldbody>\n" + content + "</worldbody>\n"; }
const HingeType& hinge(const ModuleType& type, const std::string& name) {
  return *std::ranges::find(type.hinges, name, &HingeType::name);
}

TEST_F(FromMjcf, TwoHingesInABodyAndItsClasses) {
  const ModuleType type = read_file(kImports + "two_hinges_in_a_body.xml");
  ASSERT_EQ(type.bodies.size(), 5U) << made_.text;
  EXPECT_EQ(type.bodies[1].name, "roll") << "between the hinges of `left`";
  EXPECT_EQ(type.bodies[1].mass, 0);
  const HingeType& pitch = hinge(type, "pitch");
  EXPECT_EQ(type.bodies[pitch.parent].name, "roll");
  EXPECT_EQ(type.bodies[pitch.child].name, "left");
  EXPECT_NEAR(pitch.lo, -70 * kDegree, 1e-12) << "ref is angle 0";
  EXPECT_NEAR(pitch.hi, 70 * kDegree, 1e-12);
  ASSERT_TRUE(pitch.passive);
  EXPECT_EQ(pitch.passive->stiffness, 1);
  EXPECT_NEAR(pitch.passive->rest, 10 * kDegree, 1e-12);
  EXPECT_EQ(hinge(type, "knee").hi, kNoStop);
  EXPECT_EQ(body_of(type, "shank").shapes.size(), 4U) << "a capsule of three, and the toe";
  EXPECT_EQ(made_.may_overlap, (std::vector<BodyPair>{{"trunk", "shank"}}));
  EXPECT_EQ(notes(),
            (Texts{"18 Changed: 1 ellipsoid is the convex hull of at most 32 of its points; the widest gap is 3.1 % of its "
                   "longest edge, in body 'trunk'",
                   "24 Changed: joint 'pitch' has ref 0.17453292519943295, which is angle 0 here"}));
}

TEST_F(FromMjcf, MotorsOfEveryKind) {
  const auto joint = [](const char* name) {
    return fmt::format("<joint name='{}' axis='0 1 0' damping='0.1' frictionloss='0.2' armature='0.003'/>", name);
  };
  const ModuleType type = read_mjcf(
      world(body("trunk", "<freejoint/>" + body("a", joint("gear")) +
                              body("b",
                                   "<joint name='kp' axis='0 1 0' damping='0.1' frictionloss='0.2' armature='0.003' "
                                   "actuatorfrcrange='-2 2' actuatorfrclimited='false'/>") +
                              body("c", joint("none")) + body("d", "<joint name='new' axis='0 1 0' actuatorfrcrange='-7 7'/>") +
                              body("e", joint("free")))) +
      "<actuator><motor joint='gear' gear='30' ctrllimited='true' ctrlrange='-1 0.5'/>"
      "<position joint='kp' kp='40' forcelimited='true' forcerange='-3 4'/><motor joint='none'/><position joint='new' kp='1'/>"
      "</actuator>\n");
  const auto motor = [&](const char* torque) {
    return contains(made_.text, fmt::format("stall_torque: {}, no_load_speed: 20, dry_friction: 0.2, viscous_friction: 0.1, "
                                            "rotor_inertia: 0.003",
                                            torque));
  };
  EXPECT_TRUE(motor("30")) << made_.text;
  EXPECT_TRUE(motor("4")) << made_.text;
  // Twice m g L with L the radius of gyration, sqrt(0.1 / 1).
  EXPECT_TRUE(motor("6.2")) << made_.text;
  EXPECT_TRUE(contains(made_.text, "stall_torque: 7, no_load_speed: 20, dry_friction: 0,")) << made_.text;
  ASSERT_TRUE(hinge(type, "free").passive);
  EXPECT_EQ(hinge(type, "free").passive->friction, 0.2);
  EXPECT_TRUE(made_.driven);
  EXPECT_TRUE(
      contains(made_.text, "source: \"chosen: the no-load speed, because MJCF has none; the voltage, because MJCF has none\""))
      << made_.text;
  EXPECT_EQ(
      std::ranges::count(notes(), "3 Changed: joint 'none' has a motor without a limit of force; 6.2 N m at rest is chosen"),
      0);
}

TEST_F(FromMjcf, Bases) {
  const std::string arm = body("arm", "<joint name='swing' axis='0 1 0'/>");
  const auto base = [&](const std::string& root) { return read_mjcf(world(body("trunk", root + arm))).base; };
  EXPECT_EQ(base("<freejoint/>"), Base::floating);
  EXPECT_EQ(base(""), Base::fixed);
  EXPECT_EQ(base("<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 0 1'/><joint axis='0 1 0'/>"), Base::planar);
  EXPECT_EQ(read_mjcf(world(arm)).bodies[0].name, "ground") << "a hinge on the world";
  EXPECT_EQ(refused(world(body("trunk", "\n<joint name='cart' type='slide'/>" + arm))),
            "r:4:1: error: joint 'cart' is a slide; a module has hinges; it is fixed by --lock cart");
  options_.locked = {"cart"};
  EXPECT_EQ(base("<joint name='cart' type='slide'/>"), Base::fixed);
}

TEST_F(FromMjcf, MasksOfCollisions) {
  const auto pairs = [&](const char* mask) {
    const std::string geom = fmt::format("<geom type='sphere' size='0.1' {}/>", mask);
    read_mjcf(world(body("trunk", "<freejoint/>" + geom + body("a", "<joint/>" + geom) + body("b", "<joint/>" + geom))));
    return made_.may_overlap;
  };
  EXPECT_TRUE(pairs("").empty());
  EXPECT_EQ(pairs("contype='1' conaffinity='0'"), (std::vector<BodyPair>{{"*", "*"}})) << "they touch the ground alone";
  EXPECT_TRUE(contains(made_.text, "contacts: {all: shapes}"));
}

/// Includes, meshes that are only drawn and whose files are missing, and attributes of later versions do not matter.
TEST_F(FromMjcf, WhatAModuleDoesNotNeed) {
  folder_.write("leg.xml", "<mujocoinclude>\n" + body("leg", "<joint name='hip' axis='0 1 0' actuatorgravcomp='true'/>") +
                               "</mujocoinclude>\n");
  const std::string trunk =
      "<asset><mesh name='shell' file='shell.stl'/><texture file='x.png'/></asset>\n<extension><plugin "
      "plugin='x'/></extension>\n" +
      world(body("trunk",
                 "<freejoint/><geom type='mesh' mesh='shell' contype='0' conaffinity='0'/>\n<include file='leg.xml'/>\n")) +
      "<keyframe><key qpos='0'/></keyframe><sensor><new joint='hip'/></sensor>\n<equality><connect body1='leg' anchor='0 0 "
      "0'/></equality>\n";
  const ModuleType type = read_mjcf(trunk);
  EXPECT_EQ(type.hinges.size(), 1U);
  EXPECT_EQ(notes(), (Texts{"5 Not carried over: 1 geom that does not collide", "9 Not carried over: 1 keyframe",
                            "10 Changed: 1 equality constraint"}));
}

/// Forces of several motors add up; one without a limit has none. Defaults of two sections apply, those of a class before them.
TEST_F(FromMjcf, SeveralMotorsAndSections) {
  const std::string legs = body("a", "<joint name='a' axis='0 1 0'/>") +
                           body("b", "<joint name='b' axis='0 1 0' class='weak'/>") +
                           body("c", "<joint name='c' axis='0 1 0'/>");
  read_mjcf(
      "<default><joint actuatorfrcrange='-9 9'/></default>\n<default><joint damping='0.5'/>"
      "<default class='weak'><joint actuatorfrcrange='-5 5'/></default></default>\n" +
      world(body("trunk", "<freejoint/>" + legs)) +
      "<actuator><motor joint='a' ctrllimited='true' ctrlrange='-3 3'/><motor joint='a' ctrllimited='true' ctrlrange='-4 4'/>"
      "<motor joint='b'/><motor joint='c' ctrllimited='true' ctrlrange='-3 3'/><velocity joint='c'/></actuator>");
  for (const char* const torque : {"stall_torque: 7,", "stall_torque: 5,", "stall_torque: 9,"})
    EXPECT_TRUE(contains(made_.text, torque)) << torque << "\n" << made_.text;
  EXPECT_TRUE(contains(made_.text, "viscous_friction: 0.5")) << made_.text;
}

/// A note lists properties of the joints of a root that moves freely. Joints without a name are locked by the name in the
/// message.
TEST_F(FromMjcf, RootsAndNames) {
  const std::string arm = body("arm", "\n<joint axis='0 1 0'/>");
  read_mjcf(world(body("trunk", "\n<joint type='free' damping='5' armature='1'/>" + arm)));
  EXPECT_EQ(notes(), Texts{"4 Changed: damping, armature of the joints of the root 'trunk', which moves freely"});
  EXPECT_EQ(refused(world(body("trunk", "<freejoint/>" + body("cart", "\n<joint type='slide'/>" + arm)))),
            "r:4:1: error: joint 'cart_joint' is a slide; a module has hinges; it is fixed by --lock cart_joint");
  options_.locked = {"cart_joint"};
  EXPECT_EQ(read_mjcf(world(body("trunk", "<freejoint/>" + body("cart", "\n<joint type='slide'/>" + arm)))).hinges.size(), 1U);
}

/// The robot is the tree with the most hinges that are not locked, by the names of joints in the messages.
TEST_F(FromMjcf, TheTreeWithTheMostHinges) {
  const std::string two = body("a", "<joint axis='0 1 0'/>" + body("b", "<joint axis='0 1 0'/>"));
  const std::string one = body("c", "<joint name='turn' axis='0 1 0'/>");
  EXPECT_EQ(read_mjcf(world(two + one)).hinges.size(), 2U);
  options_.locked = {"a_joint", "b_joint"};
  EXPECT_EQ(read_mjcf(world(two + one)).hinges.at(0).name, "turn");
}

/// Geoms of contact pairs collide. A NaN of which libmujoco only warns is refused.
TEST_F(FromMjcf, PairsAndNan) {
  read_mjcf(world("<geom name='floor' type='plane' size='1 1 1'/>" +
                  body("trunk", "<freejoint/><geom name='foot' type='sphere' size='0.1' contype='0' conaffinity='0'/>")) +
            "<contact><pair geom1='foot' geom2='floor'/></contact>");
  EXPECT_TRUE(contains(made_.text, "sphere: 0.1")) << made_.text;
  EXPECT_EQ(refused(world(body("trunk", "<freejoint/><geom type='sphere' size='0.1' pos='nan 0 0'/>"))),
            "r: error: has a NaN; expected finite numbers");
}

TEST_F(FromMjcf, RefusesWithAPlace) {
  const auto robot = [](const std::string& inner) { return world(body("trunk", "<freejoint/>" + inner)); };
  EXPECT_EQ(refused(robot("\n<replicate count='2'/>")),
            "r:4:1: error: <replicate> is not an element that libmujoco 2.2.2, which reads MJCF, knows at this place");
  EXPECT_EQ(refused(robot("\n<geom size='a'/>")), "r:4:1: error: libmujoco: problem reading attribute 'size' of <geom>");
  EXPECT_EQ(refused(robot(body("a", "<joint name='hip' type='ball'/>"))),
            "r:3:163: error: joint 'hip' is a ball; a module has hinges; it is fixed by --lock hip");
  EXPECT_EQ(refused(robot("") + "<actuator>\n<motor name='biceps' tendon='t'/></actuator>\n"),
            "r:6:1: error: actuator 'biceps' acts on a tendon; expected a joint");
  EXPECT_EQ(refused(robot("\n<joint axs='0 0 1'/>")),
            "r:4:1: error: 'axs' of <joint> is unknown to libmujoco 2.2.2, which reads MJCF");
  EXPECT_EQ(refused(robot("\n<composite type='grid'/>")),
            "r:4:1: error: <composite> makes bodies that the file does not list; write them out");
  EXPECT_EQ(refused("<worldbody>\n<body>\n"), "r:3:1: error: is not well-formed XML");
  EXPECT_EQ(refused(robot("<include file='none.xml'/>")), "r:3:90: error: includes 'none.xml', which is not beside r");
  EXPECT_EQ(refused(robot("<include file='r.xml'/>")), "r:3:90: error: includes 'r.xml' again; expected each file once");
  EXPECT_EQ(refused(world("")), "r: error: has no body; expected a robot in <worldbody>");
  EXPECT_TRUE(contains(message_of([&] { read_file(folder_.write("x.sdf", "<sdf/>")); }),
                       "x.sdf: error: has no element <robot> or <mujoco>; expected a URDF or MJCF file"));
}

}  // namespace
}  // namespace gaitlab::test
