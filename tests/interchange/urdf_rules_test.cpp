// The rules by which the habits and faults of public URDF files become a module, each with its note.
#include <cmath>
#include <numbers>

#include "interchange/urdf.h"
#include "tests/interchange/from_urdf.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace interchange;

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
       first + kLimit, "3 Not carried over: a material without a name"},
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
      {box, "<limit effort='3' velocity='2'/>", "4 Changed: joint 'j' has no range; it turns freely"},
      {box, "<limit lower='-1' upper='1' effort='1e9' velocity='0'/>",
       "4 Changed: joint 'j' has effort 1000000000, which counts as not stated, and velocity 0, which counts as not stated; "
       "3.92 "
       "N m at rest and 20 rad/s without load are chosen"},
      {box, "<limit lower='-1' upper='1' velocity='1e-300'/>",
       "4 Changed: joint 'j' has no effort of a motor, and velocity 1e-300, which counts as not stated; 3.92 N m at rest and "
       "20 "
       "rad/s without load are chosen"},
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
    EXPECT_EQ(found.empty() ? "" : found[0], row.note);
    EXPECT_EQ(type.bodies.size(), 2U) << row.note;
    EXPECT_EQ(type.hinges[0].hi == kNoStop, row.note.ends_with("freely")) << row.note;
    EXPECT_EQ(body_of(type, "b").shapes.at(0).size, Vec3::Ones()) << row.note;
  }
  read_urdf("<material name='red'><color rgba='1 0 0 1'/></material>\n<material name='red'/>\n" + urdf_link("a"));
  EXPECT_EQ(notes(), Texts{"3 Not carried over: material 'red', which is stated twice"});
}

/// Numbers with two meanings are refused, with urdfdom's message: a decimal comma, a vector of two numbers.
TEST_F(FromUrdf, DoesNotGuessNumbers) {
  for (const std::string origin : {"xyz='0,5 1 2'", "xyz='1 2'", "xyz='1,2,3,4'", "xyz='0,2 0,1'", "xyz='1,,2 3'",
                                   "xyz='1..0 2 3'", "xyz='1 2 x 3'", "rpy='0,5'"}) {
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
  EXPECT_EQ(
      notes(),
      (Texts{
          "0 Changed: effort and velocity become the ends of a motor's line",
          fmt::format("7 Changed: joint 'ab' has no limit of a motor; {:.3g} N m at rest and 20 rad/s without load are chosen",
                      first),
          fmt::format("8 Changed: joint 'bc' has effort 100000, which counts as not stated; {:.3g} N m at rest is chosen",
                      second),
          "9 Changed: joint 'aw' has velocity 1001, which counts as not stated; 20 rad/s without load is chosen"}));
  EXPECT_TRUE(
      contains(made_.text,
               fmt::format("    actuator: {{stall_torque: {:.3g}, no_load_speed: 20, dry_friction: 0, "
                           "viscous_friction: 0.7, rotor_inertia: 0, source: \"chosen: the URDF has no limit of a motor\"}}\n",
                           first)))
      << made_.text;
  EXPECT_TRUE(contains(made_.text, "actuator: {type: servo, voltage: 12, stall_torque: 3, no_load_speed: 7,")) << made_.text;
}

TEST_F(FromUrdf, AWheelWithoutALimit) {
  read_urdf(urdf_link("a") + urdf_link("b") + urdf_joint("j", "continuous", "a", "b", ""));
  EXPECT_TRUE(contains(made_.text, "stall_torque: 3.92, no_load_speed: 20,")) << made_.text;
  EXPECT_TRUE(contains(made_.text, "source: \"chosen: the URDF has no limit of a motor; the voltage, because URDF has none\""))
      << made_.text;
}

/// is then part of the hand, 1 m beyond its origin: m_1 m_2 / (m_1 + m_2) d^2 across.
TEST_F(FromUrdf, LockedJointsAreFixed) {
  const std::string robot =
      urdf_link("arm") + urdf_link("hand") + urdf_link("finger_l") + urdf_link("finger_r") +
      urdf_joint("wrist", "revolute", "arm", "hand", kLimit) +
      urdf_joint("finger_1", "prismatic", "hand", "finger_l", "<origin xyz='0 0 1'/><axis xyz='0 1 0'/>") +
      urdf_joint("finger_2", "revolute", "hand", "finger_r",
                 "<mimic joint='wrist'/><limit lower='-1' upper='1' effort='1' velocity='1'/>");
  EXPECT_EQ(refused(robot),
            "r:7:1: error: joint 'finger_1' is prismatic; a module has hinges; it is fixed at 0 by --lock finger_1");
  options_.locked = {"finger_1"};
  const ModuleType one = read_urdf(robot);
  EXPECT_EQ(one.hinges.size(), 2U);
  EXPECT_EQ(body_of(one, "hand").mass, 4);
  EXPECT_NEAR(body_of(one, "hand").com.z(), 0.5, 1e-16);
  EXPECT_NEAR(body_of(one, "hand").inertia(0, 0), 0.01 + 0.01 + 2.0 * 2 / 4 * 1, 1e-15);
  EXPECT_EQ(notes(), (Texts{"0 Changed: effort and velocity become the ends of a motor's line",
                            "7 Changed: joint 'finger_1' is fixed at 0, as --lock asks",
                            "8 Changed: joint 'finger_2' mimics 'wrist'; it moves independently, or is fixed by --lock "
                            "finger_1 --lock finger_2"}));
  options_.locked = {"finger*"};
  EXPECT_EQ(read_urdf(robot).hinges.size(), 1U);
  options_.locked = {"wrists"};
  EXPECT_TRUE(contains(refused(robot), "--lock: error: no joint 'wrists'; did you mean 'wrist'?")) << refused(robot);
}

/// The offered options can be copied to a shell, and fix these joints alone, whatever their names.
TEST_F(FromUrdf, LockedNamesAreVerbatim) {
  const std::string slide = "<limit lower='0' upper='1' effort='1' velocity='1'/>";
  const std::string robot = urdf_link("a") + urdf_link("b") + urdf_link("c") + urdf_link("d") +
                            urdf_joint("g*", "prismatic", "a", "b", slide) + urdf_joint("g$(x)", "revolute", "a", "c", kLimit) +
                            urdf_joint("it&apos;s", "prismatic", "a", "d", slide);
  EXPECT_TRUE(contains(refused(robot), "they are fixed at 0 by --lock 'g*' --lock 'it'\\''s'\n")) << refused(robot);
  options_.locked = {"g*"};
  EXPECT_TRUE(contains(refused(robot), "it is fixed at 0 by --lock 'g*' --lock 'it'\\''s'")) << refused(robot);
  options_.locked = {"g*", "it's"};
  EXPECT_EQ(read_urdf(robot).hinges.size(), 1U);
}

/// Parts without an effect on the motion are notes, not changes.
TEST_F(FromUrdf, DroppedPartsAreNoted) {
  const std::string drop = "<safety_controller k_velocity='1'/><calibration rising='0.1'/>";
  const std::string limit = kLimit;
  read_urdf(urdf_link("a", std::string(kInertial) + "<contact><lateral_friction value='1'/></contact>") + urdf_link("b") +
            urdf_link("c") + urdf_joint("j", "revolute", "a", "b", limit + drop) +
            urdf_joint("k", "revolute", "b", "c", "<limit lower='-1' upper='1' effort='0' velocity='0'/>" + drop));
  EXPECT_EQ(notes(), (Texts{"0 Changed: effort and velocity become the ends of a motor's line",
                            "0 Not carried over: 2 elements of <safety_controller>",
                            "0 Not carried over: 2 elements of <calibration>", "0 Not carried over: 1 element of <contact>",
                            "6 Not carried over: a motor of joint 'k', whose effort is 0"}));
}

std::string inertial(double mass, const Vec3& moments, const std::string& more = "ixy='0' ixz='0' iyz='0'") {
  return fmt::format("<inertial><mass value='{}'/><inertia ixx='{}' iyy='{}' izz='{}' {}/></inertial>", mass, moments.x(),
                     moments.y(), moments.z(), more);
}

/// others.
TEST_F(FromUrdf, ASmallestMomentIsRaised) {
  const ModuleType type = read_urdf(urdf_link("a", inertial(2, {0.01, 0.01, 0.0201})));
  EXPECT_NEAR(type.bodies[0].inertia.diagonal().minCoeff(), 0.01, 1e-16);
  EXPECT_NEAR(type.bodies[0].inertia.trace(), 2 * 0.0201, 1e-16);
  EXPECT_EQ(notes(),
            Texts{"2 Changed: no body has the principal moments 0.01, 0.01, 0.0201 kg m^2 of link 'a'; the smallest is "
                  "raised: 0.01, 0.0101, 0.0201 kg m^2"});
}

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
  std::string many;
  for (int k = 0; k < 200; ++k) many += box;
  read_urdf(urdf_link("a", inertial(6, Vec3::Zero()) + many));
  EXPECT_TRUE(contains(notes()[0], "those of a ball of water are taken")) << notes()[0];
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

/// urdfdom has the characters of XML's names such as &amp;; the notes are those of the joint as it is written.
TEST_F(FromUrdf, NamesWithEntitiesKeepTheirRules) {
  const std::string capsule = "<collision><geometry><capsule radius='0.1' length='1'/></geometry></collision>";
  const ModuleType type = read_urdf(urdf_link("a&lt;", kInertial + capsule) + urdf_link("b") +
                                    urdf_joint("j&amp;&#107;", "revolute", "a&lt;", "b", "<axis xyz='0 1 0'/>"));
  EXPECT_EQ(notes().at(2), "2 Changed: link 'a<' has a capsule, which URDF lacks: a cylinder with a sphere at each end");
  EXPECT_EQ(notes().at(3), "4 Changed: joint 'j&k' has no limit; it turns freely");
  EXPECT_EQ(type.bodies[0].shapes.size(), 3U);
}

/// Numbers that the scenario would refuse, or with which a run would diverge, are refused with their line.
TEST_F(FromUrdf, RefusesAbsurdNumbers) {
  const auto with_joint = [&](const std::string& link, const std::string& content) {
    return refused(urdf_link("a") + urdf_link("b", link) + urdf_joint("j", "revolute", "a", "b", content));
  };
  const auto box = [](const std::string& size, const std::string& at) {
    return std::string(kInertial) + "<collision><origin xyz='" + at + "'/><geometry><box size='" + size +
           "'/></geometry></collision>";
  };
  const std::string limit = kLimit;
  EXPECT_EQ(with_joint(kInertial, limit + "<dynamics damping='-0.1' friction='2e9'/>"),
            "r:4:1: error: joint 'j' has damping -0.1; expected 0 to 1e9 N m s/rad\n"
            "r:4:1: error: joint 'j' has friction 2000000000; expected 0 to 1e9 N m");
  EXPECT_EQ(with_joint(inertial(1e300, Vec3::Ones()), limit),
            "r:3:1: error: link 'b' has mass 1e+300 kg; expected at most 1e9 kg");
  EXPECT_EQ(with_joint(kInertial, limit + "<origin xyz='1e300 0 0'/>"),
            "r:4:1: error: joint 'j' has its origin too far from that of its parent; expected at most 1000000 m");
  EXPECT_EQ(with_joint(box("1e-320 1 1", "0 0 0"), limit),
            "r:3:1: error: link 'b' has a shape of 1e-320 m; expected 1e-9 m to 1e6 m");
  EXPECT_EQ(with_joint(box("1 1 1", "0 9e9 0"), limit),
            "r:3:1: error: link 'b' has a shape too far from its origin; expected at most 1000000 m");
  EXPECT_TRUE(contains(with_joint(inertial(1e9, Vec3(1, 1, 1)).insert(10, "<origin xyz='1e6 0 0'/>"), ""),
                       "r:4:1: error: joint 'j' has no limit of a motor, and one that holds what it moves has "));
}

/// Its sum with the mass of the link before it would hide a negative mass.
TEST_F(FromUrdf, MassesOfJoinedLinksAreChecked) {
  const auto joined = [](double mass) {
    return urdf_link("a") + urdf_link("b", inertial(mass, Vec3(9, 9, 9))) + urdf_joint("f", "fixed", "a", "b", "");
  };
  EXPECT_EQ(refused(joined(-1)),
            "r:3:1: error: link 'b' has mass -1 kg; expected more than 0 (only a link between two hinges may have none)");
  EXPECT_EQ(read_urdf(joined(0)).bodies[0].inertia(0, 0), 0.01);
  EXPECT_EQ(notes(), Texts{"3 Changed: link 'b' has mass 0; its inertia counts as 0"});
}

/// A root without mass that a hinge moves stands still. Its mass of 1 kg has the inertia of its shapes, m (b^2 + c^2) / 12.
TEST_F(FromUrdf, ARootWithoutMassIsAFixedBase) {
  const std::string box = "<collision><geometry><box size='0.1 0.2 0.3'/></geometry></collision>";
  const ModuleType type = read_urdf(urdf_link("stand", box) + urdf_link("arm", kInertial + box) +
                                    urdf_joint("j", "revolute", "stand", "arm", kLimit));
  EXPECT_EQ(body_of(type, "stand").mass, 1);
  EXPECT_NEAR(body_of(type, "stand").inertia(0, 0), (0.04 + 0.09) / 12, 1e-16);
  EXPECT_TRUE(type.all.empty()) << "without contacts, new scenario fixes the base";
  EXPECT_EQ(
      notes().at(1),
      "2 Changed: link 'stand' is the ground, and has a mass of 1 kg instead of none: the module has no contacts, so that "
      "new scenario writes base: fixed and no ground");
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

/// The collision touches, not the visual: a sphere of 0.02 m within a drawn one of 0.10 m.
TEST_F(FromUrdf, CollisionIsTheContact) {
  const ModuleType type = module_in(made_ = module_of_robot(kImports + "visual_is_not_contact.urdf", "ball"));
  ASSERT_EQ(body_of(type, "body").shapes.size(), 1U);
  EXPECT_EQ(body_of(type, "body").shapes[0].size.x(), 0.02);
  EXPECT_EQ(notes().at(1), "3 Not carried over: the visual shapes of link 'body'; those of collision are drawn and touch");
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
  EXPECT_EQ(notes(),
            Texts{"2 Changed: link 'a' has meshes that cannot be read as collision; its visual shapes are its contact"});
  const std::string same = "<box size='1 2 3'/>";
  read_urdf(urdf_link("a", kInertial + part("visual", same) + part("collision", same)));
  EXPECT_EQ(notes(), Texts{}) << "equal shapes lose nothing";
}

/// Our own export has the contact elements as collision. Points alone do not replace the shapes.
TEST_F(FromUrdf, PointsOfOurExportAreNotShapes) {
  const Scenario one = scenario(
      "robot: {modules: {name: box, bodies: {a: {mass: 1, shape: [{box: [0.1, 0.2, 0.3]}]}}, contacts: {all: shapes}}}\n"
      "contact: {on: all}\nduration: 1\n");
  ASSERT_EQ(one.robot->types[0].all.size(), 8U);
  const ModuleType back = module_in(made_ = module_of_robot(folder_.write("m.urdf", to_urdf(one)), "back"));
  ASSERT_EQ(back.bodies[0].shapes.size(), 1U);
  EXPECT_EQ(back.bodies[0].shapes[0].size, Vec3(0.1, 0.2, 0.3));
}

}  // namespace
}  // namespace gaitlab::test
