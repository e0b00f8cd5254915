// Robots that are not M-TRAN: module types with arbitrary frames, axes, inertia tensors and bases, read from YAML.
#include <array>
#include <cmath>

#include "core/model/pattern.h"
#include "tests/folders.h"
#include "tests/program/fixture.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

std::string list(const Vec3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0], v[1], v[2]); }

std::string list(const Mat3& m) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}, {:.17g}, {:.17g}, {:.17g}]", m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2),
                     m(1, 2));
}

/// Run of a thrown robot of three bodies and two hinges with axes that are not parallel. `turns` rotates the hinge frames,
/// which changes the description but not the robot.
Recording thrown(const std::array<Mat3, 2>& turns, const Mat3& world) {
  const std::array<Vec3, 2> origin{Vec3(0.1, 0.05, -0.2), Vec3(-0.05, 0.3, 0.1)};  // in the parent's frame without turns
  const std::array<Vec3, 2> axis{Vec3(0.6, 0, 0.8), Vec3(0, 1, 0)};
  const Vec3 com(0.03, -0.04, 0.1);
  const Mat3 inertia = rpy({0.5, 0.4, -0.3}) * Vec3(0.02, 0.03, 0.04).asDiagonal() * rpy({0.5, 0.4, -0.3}).transpose();
  std::string bodies = fmt::format("base: {{mass: 2, com: {}, inertia: {}}}", list(com), list(inertia));
  std::string hinges;
  Mat3 before = Mat3::Identity();
  for (std::size_t i = 0; i < 2; ++i) {
    // A vector v in the frame without turns is turns[i]^T v in the turned frame.
    const Mat3 back = turns[i].transpose();
    bodies += fmt::format(", b{}: {{mass: 1, com: {}, inertia: {}}}", i, list(Vec3(back * com)),
                          list(Mat3(back * inertia * turns[i])));
    hinges += fmt::format("\n      - {{name: h{}, parent: {}, child: b{}, origin: {}, rpy: {}, axis: {}, range: [-100, 100]}}",
                          i, i == 0 ? "base" : "b0", i, list(Vec3(before.transpose() * origin[i])),
                          list(to_rpy(before.transpose() * turns[i])), list(Vec3(3 * back * axis[i])));
    before = turns[i];
  }
  return run(scenario(fmt::format(R"(
gaitlab: 1
robot:
  position: {}
  orientation: {}
  modules:
    name: foreign
    bodies: {{{}}}
    hinges: {}
initial: {{angles: [0.4, -2], speeds: [3, -4], base_velocity: {}, base_angular_velocity: {}}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{integrator: rk4, step: 1e-3, gravity: {}}}
duration: 1
trace: {{period: 0.1, columns: [joint.*, base.*]}}
)",
                                  list(Vec3(world * Vec3(1, 2, 3))), list(to_rpy(world * rpy({0.3, 0.2, 0.1}))), bodies, hinges,
                                  list(Vec3(world * Vec3(0.5, 0, 1))), list(Vec3(world * Vec3(1, -2, 3))),
                                  list(Vec3(world * Vec3(0, 3, -5))))));
}

/// Largest difference of the columns that match the pattern.
double apart(const Recording& a, const Recording& b, const std::string& pattern) {
  double worst = 0;
  std::size_t compared = 0;
  for (std::size_t c = 0; c < a.trace.columns.size(); ++c) {
    if (!glob(pattern, a.trace.columns[c].name)) continue;
    ++compared;
    for (std::size_t row = 0; row < a.trace.rows(); ++row)
      worst = std::max(worst, std::abs(a.trace.at(row, c) - b.trace.at(row, c)));
  }
  EXPECT_GT(compared, 0U) << pattern;
  return worst;
}

const Mat3 kPlain = Mat3::Identity();
const std::string kRounding = "rounding of 1000 steps of numbers of 10, multiplied by the motion's own growth";

TEST(ForeignRobot, FramesOfHingesAreFree) {
  const Recording plain = thrown({kPlain, kPlain}, kPlain);
  const Recording turned = thrown({rpy({0.7, -1.1, 2}), rpy({-2, 0.4, 0.9})}, kPlain);
  validate_below(
      {"property.foreign.frames", "three bodies thrown, written in turned hinge frames: worst joint angle or speed in 1 s",
       "the same robot in plain frames", "rad, rad/s"},
      apart(plain, turned, "joint.*"), 1e-12, kRounding);
  validate_below(
      {"property.foreign.frames_base", "three bodies thrown, written in turned hinge frames: worst pose or twist in 1 s",
       "the same robot in plain frames", "m, rad"},
      apart(plain, turned, "base.*"), 1e-12, kRounding);
}

TEST(ForeignRobot, TheWorldMayBeTurned) {
  const Mat3 world = rpy({1.2, -0.5, 2.2});
  const Recording plain = thrown({kPlain, kPlain}, kPlain);
  const Recording turned = thrown({kPlain, kPlain}, world);
  validate_below({"property.foreign.world", "three bodies thrown, start and gravity turned: worst joint angle or speed in 1 s",
                  "the same throw, not turned", "rad, rad/s"},
                 apart(plain, turned, "joint.*"), 1e-12, kRounding);
  const Table a(plain.trace);
  const Table b(turned.trace);
  double path = 0;
  for (std::size_t row = 0; row < plain.trace.rows(); ++row) {
    const Vec3 p(a.at(row, "base.x"), a.at(row, "base.y"), a.at(row, "base.z"));
    const Vec3 q(b.at(row, "base.x"), b.at(row, "base.y"), b.at(row, "base.z"));
    path = std::max(path, (world * p - q).norm());
  }
  validate_below(
      {"property.foreign.world_base", "three bodies thrown, start and gravity turned: worst position of the base in 1 s",
       "the same throw, turned afterwards", "m"},
      path, 1e-12, kRounding);
}

/// Run of a robot that is thrown in the plane y = 0.
Recording in_plane(const std::string& base) {
  return run(scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: {}
  position: [1, 0, 2]
  orientation: [0, 0.6, 0]
  modules:
    name: flat
    bodies:
      first: {{mass: 1, com: [0.1, 0, 0.05], inertia: [0.02, 0.03, 0.04, 0, 0.005, 0]}}
      second: {{mass: 0.5, com: [0.2, 0, 0], inertia: [0.01, 0.02, 0.02, 0, 0, 0]}}
      third: {{mass: 0.3, com: [-0.2, 0, 0.1], inertia: [0.01, 0.02, 0.02, 0, 0, 0]}}
    hinges:
      - {{name: a, parent: first, child: second, origin: [0.3, 0, 0], rpy: [0, 0.4, 0], axis: [0, 1, 0], range: [-100, 100]}}
      - {{name: b, parent: first, child: third, origin: [-0.1, 0, 0], axis: [0, -1, 0], range: [-100, 100]}}
initial: {{angles: [1, -0.5], speeds: [2, 5], base_velocity: [0.5, 0, 3], base_angular_velocity: [0, -2, 0]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{integrator: rk4, step: 1e-3}}
duration: 1
trace: {{period: 0.1, columns: [joint.*, base.*]}}
)",
                                  base)));
}

TEST(ForeignRobot, APlanarBaseIsAFloatingOneInThePlane) {
  const Recording planar = in_plane("planar");
  const Recording floating = in_plane("floating");
  // The robot with a floating base leaves the plane only by rounding errors, because the centres of mass are in the plane.
  validate_below(
      {"property.foreign.planar", "three bodies thrown in the plane y = 0, planar base: worst joint angle or speed in 1 s",
       "the same throw with a floating base", "rad, rad/s"},
      apart(planar, floating, "joint.*"), 1e-12, kRounding);
  validate_below(
      {"property.foreign.planar_base", "three bodies thrown in the plane y = 0, planar base: worst pose or twist in 1 s",
       "the same throw with a floating base", "m, rad"},
      apart(planar, floating, "base.*"), 1e-12, kRounding);
}

TEST(ForeignRobot, TheExampleInTheManualRuns) {
  // Text of the indented block in docs/modules.md that is a scenario.
  std::istringstream page(read(std::string(gaitlab::test::source_folder()) + "/docs/modules.md"));
  std::string text;
  for (std::string line; std::getline(page, line);) {
    if (text.empty() && line != "    gaitlab: 1") continue;
    if (!line.starts_with("    ")) {
      if (!text.empty()) break;
      continue;
    }
    text += line.substr(4) + "\n";
  }
  const Scenario two_rods = scenario(text);
  EXPECT_EQ(two_rods.robot->joints.size(), 2U);
  EXPECT_EQ(run(two_rods).steps, 2000);
}

/// Output of the program for a robot whose middle body is massless.
std::string said_of(const std::string& axis, const std::string& angle) {
  const Folder folder;
  folder.write("s.yaml", fmt::format(R"(gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 0]
  modules:
    name: gimbal
    bodies:
      support: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      outer: {{mass: 0}}
      inner: {{mass: 0}}
      top: {{mass: 0.5, com: [0.1, 0, 0.1], inertia: [1e-3, 1e-3, 5e-4, 0, 0, 0]}}
    hinges:
      - {{name: one, parent: support, child: outer, axis: [0, 0, 1], range: [-10, 10]}}
      - {{name: two, parent: outer, child: inner, axis: {}, range: [-10, 10]}}
      - {{name: three, parent: inner, child: top, axis: [0, 0, 1], range: [-10, 10]}}
initial: {{angles: [0.3, {}, 0.2]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
duration: 0.1
)",
                                     axis, angle));
  const Result result = gaitlab("run s.yaml --out out", folder / "");
  EXPECT_EQ(std::filesystem::exists(folder / "out"), result.code == 0);
  return result.code == 0 ? "" : result.err;
}

TEST(ForeignRobot, AJointWithoutInertiaIsRefused) {
  const std::string refusal =
      "s.yaml:2:1: error: joint 'm0/{}' moves no inertia: the next joint turns about the same axis (gimbal lock). Give "
      "the body between the two hinges mass, or start at other angles\n";
  EXPECT_EQ(said_of("[1, 0, 0]", "0.5"), "");
  EXPECT_EQ(said_of("[1, 0, 0]", "0"), fmt::format(fmt::runtime(refusal), "one")) << "gimbal lock";
  EXPECT_EQ(said_of("[0, 0, 1]", "0.5"), fmt::format(fmt::runtime(refusal), "two")) << "in line";
}

}  // namespace
}  // namespace gaitlab::test
