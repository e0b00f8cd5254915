#include "report/figures/run/side_view.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/report/sample.h"

namespace gaitlab::report {
namespace {

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

// Side view of a robot of one body with this shape at `pose`.
Outline seen(const Shape& shape, const Pose& pose) {
  ModuleType type;
  type.name = "thing";
  type.bodies = {{"body", 1, Vec3::Zero(), Mat3::Identity(), {shape}}};
  const Robot robot = assemble({type}, {0}, {});
  RobotState state;
  state.position = pose.p;
  state.orientation = Quat(pose.R);
  return side_view(robot, sample::kinematics(robot, state)).at(0);
}

TEST(ConvexHull, LeavesOutInnerPointsAndEdges) {
  const Polygon hull = convex_hull({{0, 0}, {1, 1}, {1, 0}, {0.5, 0.5}, {0, 1}, {0.5, 0}, {0, 0}});
  ASSERT_EQ(hull.size(), 4U);
  EXPECT_DOUBLE_EQ(area(hull), 1);  // positive, because the corners are counter-clockwise
}

TEST(SideView, ShapesHaveTheirAreas) {
  const Pose upright{Mat3::Identity(), {3, 4, 5}};
  const double r = 0.1;
  const double round = 12 * r * r * math::sin(sample::kPi / 12);  // area of a regular polygon with 24 corners
  EXPECT_NEAR(area(seen({Shape::Kind::box, {}, {0.3, 0.2, 0.1}}, upright).polygons.at(0)), 0.03, 1e-12);
  EXPECT_NEAR(area(seen({Shape::Kind::cylinder, {}, {r, 0.2, 0}}, upright).polygons.at(0)), round, 1e-12);
  EXPECT_NEAR(area(seen({Shape::Kind::half_cylinder, {}, {r, 0.2, 0}}, upright).polygons.at(0)), round / 2, 1e-12);
  EXPECT_NEAR(area(seen({Shape::Kind::sphere, {}, {r, 0, 0}}, upright).polygons.at(0)), round, 1e-12);
  // The outline of a box that is rotated by 45 degrees about the vertical has the width of its diagonal. The outline of a
  // cylinder on its side is a rectangle.
  const Pose turned{rpy({0, 0, sample::kPi / 4}), Vec3::Zero()};
  EXPECT_NEAR(area(seen({Shape::Kind::box, {}, {0.1, 0.1, 0.3}}, turned).polygons.at(0)), 0.3 * 0.1 * std::sqrt(2.0), 1e-12);
  const Pose aside{rpy({0, 0, sample::kPi / 2}), Vec3::Zero()};
  EXPECT_NEAR(area(seen({Shape::Kind::cylinder, {}, {r, 0.5, 0}}, aside).polygons.at(0)), 2 * r * 0.5, 1e-12);
  EXPECT_NEAR(area(seen({Shape::Kind::sphere, {}, {r, 0, 0}}, turned).polygons.at(0)), round, 1e-12);
}

TEST(SideView, HalfCylindersBulgeForward) {
  const Outline outline = seen({Shape::Kind::half_cylinder, {}, {0.1, 0.2, 0}}, {Mat3::Identity(), {1, 0, 0}});
  for (const Point& point : outline.polygons.at(0)) {
    EXPECT_GE(point.x, 1 - 1e-12);
    EXPECT_LE(point.x, 1.1 + 1e-12);
  }
}

TEST(SideView, CaterpillarIsFlatAtZeroAngles) {
  const Robot robot = sample::caterpillar(8);
  RobotState state;
  state.q.assign(robot.joints.size(), 0);
  const std::vector<Outline> outlines = side_view(robot, sample::kinematics(robot, state));
  ASSERT_EQ(outlines.size(), 24U);
  std::map<Role, int> roles;
  for (const Outline& outline : outlines) {
    ++roles[outline.role];
    for (const Polygon& polygon : outline.polygons) {
      EXPECT_GT(area(polygon), 0);
      for (const Point& point : polygon) {
        EXPECT_NEAR(point.y, 0, 0.0325 + 1e-12);
        EXPECT_GE(point.x, -0.065 - 1e-12);
        EXPECT_LE(point.x, 7 * 0.13 + 0.065 + 1e-12);
      }
    }
  }
  EXPECT_EQ(roles[Role::active], 8);
  EXPECT_EQ(roles[Role::passive], 8);
  EXPECT_EQ(roles[Role::link], 8);
  // All links are drawn before the blocks, which hide the links inside them.
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(outlines[k].role, Role::link);
}

TEST(SideView, FarLegsComeBeforeTheSpineAndNearOnesAfter) {
  const Robot robot = sample::hexapod();
  RobotState state;
  state.q.assign(robot.joints.size(), 0);
  const std::vector<Outline> outlines = side_view(robot, sample::kinematics(robot, state));
  ASSERT_EQ(outlines.size(), 33U);
  const auto lowest = [](const Outline& outline) { return sample::lowest({0, {outline}}); };
  int far_feet = 0;
  int near_feet = 0;
  for (std::size_t k = 0; k < 33; ++k) {
    if (lowest(outlines[k]) > -0.09) continue;
    far_feet += k < 9 ? 1 : 0;
    near_feet += k >= 24 ? 1 : 0;
  }
  EXPECT_EQ(far_feet, 3);
  EXPECT_EQ(near_feet, 3);
}

TEST(SideView, OrderIsUnmovedByRounding) {
  const Robot robot = sample::caterpillar(3);
  RobotState state;
  state.q.assign(robot.joints.size(), 0.3);
  const auto roles = [&] {
    std::vector<Role> roles;
    for (const Outline& outline : side_view(robot, sample::kinematics(robot, state))) roles.push_back(outline.role);
    return roles;
  };
  const std::vector<Role> before = roles();
  state.orientation = turn(Vec3::UnitZ(), 1e-12);
  EXPECT_EQ(roles(), before);
}

}  // namespace
}  // namespace gaitlab::report
