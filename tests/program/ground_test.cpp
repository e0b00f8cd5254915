// Boxes and heightfields in every engine: a block rests, creeps and slides according to the closed forms of eq. 12, and a ball
// touches two boxes at once. Queries of random boxes have the symmetries and the slope of a distance.
#include "core/laws/ground.h"

#include <rapidcheck.h>

#include <cmath>

#include "core/simulation/start.h"
#include "report/verdict/numbers/summary_text.h"
#include "tests/oracles/blocks.h"
#include "tests/program/block.h"
#include "tests/program/engines.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

/// Block of 1 kg on four points, with its centre of mass in their plane, on a ground that is inclined by `slope` about y.
Scenario block(const std::string& engine, const std::string& ground, double slope, const std::string& rest, double duration) {
  return scenario(fmt::format(R"(
gaitlab: 1
{}ground: {}
actuator: {{type: none}}
duration: {}
trace: {{period: 1e-3, columns: [base.*, contact.*]}}
physics: {{engine: {}, integrator: rk4, step: 5e-5}}
{}
)",
                              block_robot(fmt::format("  orientation: [0, {:.17g}, 0]\n", slope)), ground, duration, engine,
                              rest));
}

constexpr double kSlope = 0.2;  // inclination of the ground, rad

const std::string kTiltedBox = "{type: boxes, boxes: [{center: [0, 0, 1], size: [4, 1, 0.2], rpy: [0, 0.2, 0]}]}";
/// Heightfield of the inclined plane z = -x tan(0.2), with heights of 17 digits.
std::string tilted_field() {
  const double fall = 0.5 * std::tan(kSlope);
  std::string row;
  for (int i = -4; i <= 4; ++i) row += fmt::format("{}{:.17g}", row.empty() ? "" : ", ", -i * fall);
  return fmt::format("{{type: heightfield, heightfield: {{values: [[{0}], [{0}], [{0}]], origin: [-2, -2, 0], spacing: 0.5}}}}",
                     row);
}

class OnGround : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, OnGround, engines(), engine_name);

// On an inclined box or heightfield, friction holds a block as on a horizontal plane with inclined gravity.
TEST_P(OnGround, HoldsABlockOnATiltedBoxByFriction) {
  for (const std::string& ground : {kTiltedBox, tilted_field()}) {
    const Recording record = run(block(GetParam(), ground, kSlope, "", 0.4));
    const double creep = oracle::SlidingBlock{0.8, 9.81, 0.01}.creeps(kSlope);
    validate({"closed.block.tilted.creep", "block on a box or heightfield tilted by 0.2 rad: speed at which it creeps", kEq12,
              "m/s"},
             std::hypot(end(record, "base.vx"), end(record, "base.vz")), creep, 2.5e-10,
             "of the swing normal to it, 0.05 m/s at first, exp(-n Cd p t / 2 m) = exp(-19) is left");
    EXPECT_NEAR(end(record, "base.vz") / end(record, "base.vx"), -std::tan(kSlope), 1e-6);
    double carried = 0;
    for (int c = 0; c < 4; ++c) carried += end(record, fmt::format("contact.{}.fn", c));
    EXPECT_NEAR(carried, 9.81 * std::cos(kSlope), 1e-6);
  }
}

TEST_P(OnGround, LetsABlockSlideWhereFrictionIsTooSmall) {
  // Because f = 0.1 < tan(0.2), the block slides, and above v_lim it accelerates by g (sin a - f cos a).
  const std::string box = "{type: boxes, boxes: [{center: [0, 0, 1], size: [4, 1, 0.2], rpy: [0, 0.2, 0], friction: 0.1}]}";
  const Recording record = run(block(GetParam(), box, kSlope, "", 0.4));
  const Table table(record.trace);
  const auto speed = [&](double t) { return std::hypot(table(t, "base.vx"), table(t, "base.vz")); };
  validate({"closed.block.tilted.slide", "block on a box tilted by 0.2 rad, f = 0.1: acceleration", kEq12, "m/s^2"},
           (speed(0.4) - speed(0.3)) / 0.1, 9.81 * (std::sin(kSlope) - 0.1 * std::cos(kSlope)), 3e-7,
           "of the swing normal to it, 0.05 m/s at first, exp(-48 * 0.3) is left: 3e-8 m/s over 0.1 s");
}

// The force on a ball in the corner of a floor and a wall is the sum of the forces of both.
TEST_P(OnGround, CarriesABallOnAFloorAndAgainstAWall) {
  const Scenario s = scenario(fmt::format(R"(
gaitlab: 1
robot:
  position: [-0.05, 0, 0.05]
  modules:
    name: ball
    bodies: {{ball: {{mass: 1, inertia: [0.001, 0.001, 0.001, 0, 0, 0]}}}}
    contacts: {{feet: [{{body: ball, sphere: [0, 0, 0], radius: 0.05}}]}}
ground: {{type: boxes, friction: 0, boxes: [{{center: [0.5, 0, 0.5], size: [1, 1, 1], friction: 0}}]}}
actuator: {{type: none}}
duration: 1
trace: {{period: 1e-3, columns: [base.*, contact.*]}}
physics: {{engine: {}, step: 2.5e-5, gravity: [3, 0, -9.81]}}
)",
                                          GetParam()));
  const Recording record = run(s);
  // The forces, Kn times the depths, are 3 N at the wall and 9.81 N on the floor.
  const std::string what = "ball pressed into the corner of floor and wall: depth ";
  validate({"closed.corner.wall", what + "in the wall, m g_x / Kn", kEq12, "m"}, end(record, "base.x") + 0.05, 3e-4, 5e-14,
           "the swing is gone (exp(-Cd p t / 2 m) = exp(-50)); rounding of 0.05 m, 7e-18, some thousand times");
  validate({"closed.corner.floor", what + "in the floor, m g_z / Kn", kEq12, "m"}, 0.05 - end(record, "base.z"), 9.81e-4, 5e-14,
           "the same");
}

TEST(GroundStart, LowersTheRobotAtItsPlace) {
  const auto start = [](const std::string& ground, const std::string& position) {
    return start_state(scenario("gaitlab: 1\nrobot: {modules: mtran, position: " + position +
                                "}\ncontact: {on: all}\nground: " + ground + "\nduration: 1\n"))
        .position;
  };
  const std::string box = "{type: boxes, boxes: [{center: [3, -1, 0.05], size: [1, 1, 0.1]}]}";
  EXPECT_EQ(start("{type: plane}", "[3, -1]").head<2>(), Vec3(3, -1, 0).head<2>());
  EXPECT_NEAR(start("{type: plane}", "[3, -1]").z(), 0.0325, 1e-12);
  EXPECT_NEAR(start(box, "[3, -1]").z(), 0.1325, 1e-12);
  EXPECT_NEAR(start(box, "[3.3, -0.8]").z(), 0.1325, 1e-12);
  EXPECT_NEAR(start(box, "[0, 0]").z(), 0.0325, 1e-12);
  EXPECT_EQ(start(box, "[3, -1, 0.7]"), Vec3(3, -1, 0.7));
  EXPECT_EQ(start("{type: none}", "[3, -1]"), Vec3(3, -1, 0));
  // The heightfield rises by 0.1 m per metre towards the front, so that the foremost points touch first.
  const std::string row = "[0, 0.1, 0.2, 0.3]";
  const std::string field =
      "{type: heightfield, heightfield: {values: [" + row + ", " + row + ", " + row + "], origin: [0, -1, 0], spacing: 1}}";
  for (const double x : {0.5, 1.2, 2.4}) {
    EXPECT_NEAR(start(field, fmt::format("[{}, 0.3]", x)).z(), 0.1 * (x + 0.065) + 0.0325, 1e-12) << x;
  }
}

TEST(GroundStart, SaysWhyTheRobotIsDeepInTheGround) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  std::filesystem::create_directory_symlink(kScenarios + "robots", folder / "robots");
  const auto stands = [&](const std::string& start) {
    folder.write("s.yaml", "gaitlab: 1\nrobot: {modules: mtran, build: robots/hexapod.dat" + start + "}\nduration: 0.015\n");
    Result check = gaitlab("check s.yaml", folder / "");
    std::filesystem::remove_all(folder / "runs");
    const Result run = gaitlab("run s.yaml --quiet", folder / "");
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err.substr(0, check.err.size()), check.err);
    return check;
  };
  const Result deep = stands(", position: [0.5, 0.25, 0]");
  EXPECT_EQ(
      deep.err,
      "s.yaml:2:62: warning: the robot starts 0.0975 m deep in the ground: on_ground is off (a position of three numbers "
      "turns it off) and the base frame starts at z = 0 m; position: [0.5, 0.25] lowers the robot onto the ground there\n");
  EXPECT_NE(
      deep.out.find("  base frame at [0.5, 0.25, 0] m at the start: at the height in position, because on_ground is off\n"),
      std::string::npos)
      << deep.out;
  const Result lowered = stands(", position: [0.5, 0.25]");
  EXPECT_EQ(lowered.err, "");
  EXPECT_NE(lowered.out.find("  base frame at [0.5, 0.25, 0.0975] m at the start: lowered onto the ground\n"),
            std::string::npos)
      << lowered.out;
  EXPECT_EQ(
      stands(", orientation: [3.141592653589793, 0, 0]").err,
      "s.yaml: warning: the robot starts 0.13 m deep in the ground: only the elements of contact.on: feet touch it; is it "
      "upside down?\n");
}

/// A lying cylinder, turned by half the angle between two contact elements of its rims, reaches below them.
TEST(GroundStart, ShapesReachBelowTheirElements) {
  const Scenario s = scenario(R"(
gaitlab: 1
robot:
  modules:
    gaitlab_module: 1
    name: foot
    bodies:
      body: {mass: 1, shape: [{box: [0.2, 0.2, 0.05], origin: [0, 0, 0.2]}]}
      leg: {mass: 0.5, shape: [{cylinder: [0.115, 0.1], rpy: [0, 0.3927, 0]}]}
    hinges: [{name: hip, parent: body, child: leg, axis: [0, 1, 0], range: [-1, 1]}]
    contacts: {all: shapes}
actuator: {type: none}
contact: {on: all}
duration: 1
)");
  const std::string warning = report::start_warning(s);
  EXPECT_TRUE(
      warning.ends_with("its shapes reach below their contact elements, of which a cylinder has 8 on each rim; turn or "
                        "move it"))
      << warning;
}

TEST(GroundStart, LowersTheRobotOntoWhatIsBelow) {
  const auto height = [](const std::string& ground, const std::string& more = "") {
    return start_state(scenario("gaitlab: 1\nrobot: {modules: mtran" + more + "}\ncontact: {on: all}\nground: " + ground +
                                "\nduration: 1\n"))
        .position.z();
  };
  EXPECT_NEAR(height("{type: boxes, boxes: [{center: [5, 0, 1], size: [1, 1, 1]}]}"), 0.0325, 1e-12);
  EXPECT_NEAR(height("{type: boxes, boxes: [{center: [0, 0, 0.05], size: [1, 1, 0.1]}]}"), 0.1325, 1e-12);
  // On a box that rises towards the front by 0.1 rad, the vertices of the front face, 0.065 m ahead of the middle, touch first.
  const double top = 0.5 + 0.05 / std::cos(0.1);
  EXPECT_NEAR(height("{type: boxes, boxes: [{center: [0, 0, 0.5], size: [1, 1, 0.1], rpy: [0, -0.1, 0]}]}"),
              top + 0.065 * std::tan(0.1) + 0.0325, 1e-9);
  EXPECT_NEAR(height("{type: heightfield, heightfield: {values: [[0, 0], [0, 0]], origin: [-1, -1, -0.3]}}"), 0.0325 - 0.3,
              1e-12);
}

// A query of a random box gives the same result if box and element are mirrored or moved together. If the element moves by d,
// the depth changes by at most d.
TEST(GroundProperty, ABoxIsTheSameFromEverySide) {
  const auto number = [](double lo, double hi) {
    return lo + (hi - lo) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1000001)) / 1e6;
  };
  const auto vector = [&](double size) { return Vec3(number(-size, size), number(-size, size), number(-size, size)); };
  const auto check = [&] {
    Box box;
    box.center = Vec3(0, 0, 20) + vector(5);
    box.size = Vec3(0.5, 0.5, 0.5) + vector(0.45);
    box.rpy = vector(3);
    box.R = rpy(box.rpy);
    const Ground ground{.shape = Boxes{box}};
    const Vec3 local = vector(0.8);
    const double radius = number(0, 0.2);
    const Vec3 centre = box.center + box.R * local;
    const Ground::Touch touch = ground.query(centre, radius);
    RC_ASSERT(std::abs(touch.normal.norm() - 1) < 1e-12);
    RC_ASSERT((touch.point - (centre - radius * touch.normal)).norm() < 1e-12);
    RC_ASSERT(std::abs(touch.penetration - radius - ground.query(centre, 0).penetration) < 1e-12);
    // The element is mirrored in the planes of the box and rotated with the box.
    Box turned = box;
    turned.rpy = vector(3);
    turned.R = rpy(turned.rpy);
    const Ground other{.shape = Boxes{turned}};
    const Vec3 signs(*rc::gen::element(-1.0, 1.0), *rc::gen::element(-1.0, 1.0), *rc::gen::element(-1.0, 1.0));
    const Ground::Touch seen = other.query(box.center + turned.R * signs.cwiseProduct(local), radius);
    RC_ASSERT(std::abs(seen.penetration - touch.penetration) < 1e-12);
    // The depth is a distance, which changes by at most the length of the step.
    const Vec3 step = vector(0.01);
    RC_ASSERT(std::abs(ground.query(centre + step, radius).penetration - touch.penetration) < step.norm() + 1e-12);
  };
  EXPECT_TRUE(rc::check(check));
}

TEST(GroundFigure, DrawsTheBoxesAndMjcfHoldsThem) {
  const Folder folder;
  const std::string rubble = "'" + kScenarios + "rubble.yaml'";
  EXPECT_EQ(gaitlab("export " + rubble + " --to mjcf r.xml", folder / "").code, 0);
  const std::string xml = read(folder / "r.xml");
  EXPECT_NE(xml.find("<geom name=\"ground/3\" type=\"box\" size=\"0.11 0.12 0.004\" pos=\"1.16 0.14 0.004\""),
            std::string::npos)
      << xml;
  folder.write("f.yaml",
               "gaitlab: 1\nrobot: {modules: {name: one, bodies: {b: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}}}\n"
               "ground: {type: heightfield, heightfield: {values: [[0, 0], [0, 1]]}}\nduration: 1\n");
  const Result refused = gaitlab("export f.yaml --to mjcf f.xml", folder / "");
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err, "f.yaml:3:16: error: MJCF holds no heightfield of this kind; expected type: none, plane or boxes\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "f.xml"));
}

}  // namespace
}  // namespace gaitlab::test
