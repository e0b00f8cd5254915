// Overlaps of bodies of one module: by design, on one hinge, and left out by may_overlap.
#include "report/analysis/own_overlap.h"

#include <cmath>
#include <numbers>

#include "core/scenario/resolved.h"
#include "core/simulation/start.h"
#include "report/verdict/plausible/plausibility.h"
#include "report/verdict/warnings.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

/// Collision of a robot at these angles of its joints.
std::optional<Collision> at(const Scenario& s, const std::vector<double>& angles) {
  RobotState state = start_state(s);
  state.q = angles;
  return collision_in(s, state);
}

/// Two boxes 42 mm deep and 3 mm apart, with a hinge between them. `docks` may dock the module by its second body.
std::string fold(const std::string& more = "", const std::string& robot = "modules: fold") {
  return fmt::format(R"(
gaitlab: 1
robot:
  {1}
  base: fixed
  position: [0, 0, 1]
  types:
    fold:
      gaitlab_module: 1
      name: fold
      bodies:
        one: {{mass: 0.05, shape: [{{box: [0.02, 0.042, 0.07], origin: [-0.0115, 0, 0]}}]}}
        other: {{mass: 0.05, shape: [{{box: [0.02, 0.042, 0.05], origin: [0.0115, 0, 0.01]}}]}}
      hinges: [{{name: h, parent: one, child: other, axis: [0, 1, 0], range: [-3.1, 3.1]}}]
      faces:
        - {{id: 0, body: one, gender: none, origin: [-0.0215, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}}
        - {{id: 1, body: other, gender: none, origin: [0.0215, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}}
      actuator: {{type: servo, voltage: 6, stall_torque: 2, no_load_speed: 6}}
      controller: {{type: pid, Kp: 20}}
{0}
ground: {{type: none}}
contact: {{on: none}}
physics: {{engine: articulated}}
cpg: {{type: sine, frequency: 0.25, amplitude: 2}}
duration: 8
)",
                     more, robot);
}

/// The depth at an angle agrees with a closed form. If the module folds up, the lower corner of the second box, 15 mm below the
/// axis, enters the first box. If the module is docked by its second body, the depth is the same at the opposite joint angle.
TEST(OwnOverlap, OfTheBodiesOfOneHinge) {
  const Scenario s = scenario(fold());
  for (const double angle : {0.0, 0.09, -0.03}) EXPECT_FALSE(at(s, {angle})) << angle;
  const double angle = 0.3;  // the corner at (1.5, -15) mm moves to x = 1.5 cos - 15 sin; the face of the first box is at -1.5
  const std::optional<Collision> folded = at(s, {angle});
  ASSERT_TRUE(folded);
  EXPECT_NEAR(folded->depth, 0.015 * std::sin(angle) - 0.0015 * std::cos(angle) - 0.0015, 1e-12);
  EXPECT_EQ(folded->pairs, 1U);
  const std::optional<Collision> back = at(s, {-angle});  // the upper corner, 35 mm above the axis, enters
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->depth, 0.035 * std::sin(angle) - 0.0015 * std::cos(angle) - 0.0015, 1e-12);

  const Scenario hung = scenario(fold("", "modules: fold\n  docks: [[1, 1, 1, 0, 0]]"));
  const std::optional<Collision> other = at(hung, {0, -angle});
  ASSERT_TRUE(other);
  EXPECT_NEAR(other->depth, folded->depth, 1e-9);
}

/// The bits of the depth do not depend on angles that were evaluated before.
TEST(OwnOverlap, KeepsClearAngles) {
  const Scenario s = scenario(fold());
  HingeOverlap asked(s.robot->types[0], 0, 0, 5e-4);
  for (int k = 0; k < 477; ++k) {
    const double angle = -3.1 + 0.013 * k;
    HingeOverlap fresh(s.robot->types[0], 0, 0, 5e-4);
    EXPECT_EQ(asked.beyond(angle), fresh.beyond(angle)) << angle;
    EXPECT_EQ(asked.beyond(angle + 1e-4), HingeOverlap(s.robot->types[0], 0, 0, 5e-4).beyond(angle + 1e-4)) << angle;
  }
}

/// A gait that folds a module into itself is infeasible, and the check of the scenario names the hinge.
TEST(OwnOverlap, AModuleThatFoldsIntoItself) {
  const auto judged = [](const Scenario& s) {
    const Recording record = run(s);
    return verdict(s, record, summarise(s, record, 0), overlaps(s, record));
  };
  const auto status = [](const Verdict& made) { return std::ranges::find(made.checks, "collision", &Check::id)->status; };
  const Scenario s = scenario(fold());
  const Verdict made = judged(s);
  EXPECT_EQ(made.word, Word::infeasible) << made.why();
  EXPECT_EQ(made.decided_by, "collision");
  EXPECT_TRUE(contains(made.why(), "deepest m0/one and m0/other, by ")) << made.why();
  const auto named = [](const Scenario& one) {
    return std::ranges::any_of(implausible(one).warnings, [](const Warning& warning) {
      return contains(warning.text, "over its range the bodies of hinge 'h' of fold overlap by up to ");
    });
  };
  EXPECT_TRUE(named(s));
  const Scenario free = scenario(fold("      may_overlap: [[one, \"oth*\"]]"));
  EXPECT_EQ(status(judged(free)), CheckStatus::pass);
  EXPECT_TRUE(contains(judged(free).figures, "may_overlap leaves out fold/one and fold/oth*"));
  EXPECT_FALSE(named(free));
  const Scenario of_robot = scenario(fold("", "modules: fold\n  may_overlap: [[m0/other, \"m*/one\"]]"));
  EXPECT_EQ(status(judged(of_robot)), CheckStatus::pass);
  EXPECT_TRUE(contains(judged(of_robot).figures, "may_overlap leaves out m0/other and m*/one"));
  EXPECT_EQ(scenario(resolved(of_robot)).may_overlap, of_robot.may_overlap);
}

/// `shape: []` states that a body has no extent; a body without the key leaves the checks of overlaps without an answer.
TEST(OwnOverlap, ABodyWithoutExtent) {
  const auto judged = [](const char* shape) {
    const Scenario s = scenario(
        "{gaitlab: 1, robot: {modules: rods, types: {rods: {gaitlab_module: 1, name: rods, bodies: {"
        "trunk: {mass: 1, inertia: [0.1, 0.1, 0.1, 0, 0, 0], shape: [{box: [0.2, 0.2, 0.1]}]}, "
        "hip: {mass: 0.1, inertia: [0.001, 0.001, 0.001, 0, 0, 0]" +
        std::string(shape) +
        "}}, hinges: [{name: h, parent: trunk, child: hip, axis: [0, 1, 0], range: [-1, 1]}], contacts: {all: shapes}, "
        "actuator: {type: servo, voltage: 6, stall_torque: 1, no_load_speed: 6}, controller: {type: pid, Kp: 5}}}}, "
        "physics: {engine: articulated}, cpg: {type: sine, frequency: 1, amplitude: 0.1}, contact: {on: all}, duration: 4}");
    const Recording record = run(s);
    return verdict(s, record, summarise(s, record, 0), overlaps(s, record));
  };
  const auto status = [](const Verdict& made, const char* id) {
    return std::ranges::find(made.checks, id, &Check::id)->status;
  };
  for (const char* const id : {"collision", "in_ground"}) {
    EXPECT_EQ(status(judged(""), id), CheckStatus::not_judged) << id;
    EXPECT_EQ(status(judged(", shape: []"), id), CheckStatus::pass) << id;
  }
  EXPECT_TRUE(contains(judged(", shape: []").figures, "shape: [] leaves out rods/hip")) << judged(", shape: []").figures;
}

/// A hip overlaps its trunk, and a leg overlaps both by design. The leg may turn there by 0.3 rad, but a raised leg enters the
/// trunk.
TEST(OwnOverlap, ByDesign) {
  const std::string legged = R"(
gaitlab: 1
robot:
  modules:
    gaitlab_module: 1
    name: dog
    bodies:
      trunk: {mass: 1, shape: [{box: [0.1, 0.1, 0.1]}]}
      hip: {mass: 0.1, shape: [{box: [0.04, 0.04, 0.04]}]}
      leg: {mass: 0.1, shape: [{box: [0.03, 0.03, 0.2], origin: [0, 0, -0.1]}]}
    hinges:
      - {name: a, parent: trunk, child: hip, origin: [0, 0, -0.04], axis: [1, 0, 0], range: [-1, 1]}
      - {name: b, parent: hip, child: leg, axis: [0, 1, 0], range: [-1.5, 1.5]}
    contacts: {all: shapes}
ground: {type: none}
contact: {on: none}
duration: 1
)";
  const Scenario s = scenario(legged);
  EXPECT_NEAR(DesignOverlap(s.robot->types[0]).depth(0, 2), 0.01, 1e-12);
  for (const double angle : {0.0, 0.3, -0.3}) EXPECT_FALSE(at(s, {0, angle})) << angle;
  const std::optional<Collision> raised = at(s, {0, 1.5});  // the leg lies along the trunk's lower face
  ASSERT_TRUE(raised);
  EXPECT_EQ(raised->pairs, 1U) << "and not of the hip, whose corners reach no farther than those of a square that turns";
  EXPECT_NEAR(raised->depth, 0.01 + 0.015 * std::sin(1.5) - std::numbers::sqrt2 * 0.01, 1e-12);
  EXPECT_FALSE(at(scenario(legged, {"robot.may_overlap=[[m0/leg, m0/trunk]]"}), {0, 1.5}));
  const std::vector<Warning> notes = setup_warnings(s);
  EXPECT_TRUE(std::ranges::any_of(notes, [](const Warning& note) {
    return !note.severe && note.text ==
                               "bodies trunk and leg of dog overlap by 10 mm with all hinges at 0: only more than 14.1 mm "
                               "counts as a collision";
  }));
}

/// The overlap of an axle with its wheel is by design at all angles, although round shapes are prisms here.
TEST(OwnOverlap, ARoundAxleInItsWheel) {
  ModuleType type;
  type.name = "wheel";
  type.bodies = {{"axle"}, {"wheel"}};
  type.bodies[0].shapes = {{Shape::Kind::cylinder, {}, {0.1, 3, 0}}};
  type.bodies[1].shapes = {{Shape::Kind::cylinder, {}, {1, 2, 0}}};
  type.hinges = {{"h", 0, 1, {}, Vec3::UnitY(), -kNoStop, kNoStop}};
  EXPECT_LT(deepest_in_range(type, 0), 1e-9);
}

}  // namespace
}  // namespace gaitlab::test
