#include "report/analysis/convex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/model/hull_shape.h"
#include "core/model/solid.h"

namespace gaitlab::report {
namespace {

constexpr double kPi = std::numbers::pi;

Convex at(const Shape& shape, const Vec3& p, const Vec3& axis = Vec3::UnitX(), double angle = 0) {
  return moved(convex(shape), {turn(axis, angle).toRotationMatrix(), p});
}

Shape box(double x, double y, double z) { return {Shape::Kind::box, {}, {x, y, z}}; }
Shape ball(double radius) { return {Shape::Kind::sphere, {}, {radius, 0, 0}}; }

// The tolerances 1e-15 and 1e-14 are for the rounding errors of one and of several products of lengths of about 1.

TEST(Convex, BoxesFaceToFace) {
  EXPECT_NEAR(penetration(at(box(2, 2, 2), {0, 0, 0}), at(box(1, 1, 1), {1.4, 0, 0}), 0), 0.1, 1e-15);
  EXPECT_EQ(penetration(at(box(2, 2, 2), {0, 0, 0}), at(box(1, 1, 1), {1.6, 0, 0}), 0), 0);
  EXPECT_EQ(penetration(at(box(2, 2, 2), {0, 0, 0}), at(box(1, 1, 1), {1.4, 0, 0}), 0.2), 0) << "ignored";
}

/// The hull of the corners of a box overlaps others as the box does.
TEST(Convex, AHullOfABoxIsTheBox) {
  const Vec3 size(2, 2, 2);
  const std::array<Vec3, 8> corners = box_corners(size);
  const Shape hull = hull_shape({}, corners).value();
  EXPECT_EQ(convex(hull).normals.size(), 3U) << "one for each pair of opposite faces";
  EXPECT_EQ(convex(hull).directions.size(), 3U) << "one for all parallel edges";
  for (int k = 0; k < 20; ++k) {
    const Convex other = at(box(1, 3, 0.5), Vec3(1.4, 0.1 * k, 0.05 * k), Vec3(1, 2, 3).normalized(), 0.3 * k);
    EXPECT_NEAR(penetration(at(hull, {0, 0, 0}), other, 0), penetration(at(box(2, 2, 2), {0, 0, 0}), other, 0), 1e-14) << k;
  }
}

/// Two hulls of random points: the shortest way out is that of a search over 40 000 directions, which finds one at most 0.02
/// rad away.
TEST(Convex, HullsOfRandomPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto drawn = [&] {
    std::vector<Vec3> points;
    for (int k = 0; k < 24; ++k) {
      const double x = any(random), y = any(random), z = any(random);
      points.emplace_back(x, y, z);
    }
    return convex(hull_shape({}, points).value());
  };
  constexpr int kDirections = 40000;  // on a spiral of Fibonacci
  for (int pair = 0; pair < 10; ++pair) {
    const Convex a = drawn();
    const Convex b = moved(drawn(), {Mat3::Identity(), {0.2 * pair, 0.1, 0.3}});
    double least = 1e9;
    for (int k = 0; k < kDirections; ++k) {
      const double z = 1 - (2 * k + 1.0) / kDirections;
      const double angle = kPi * (3 - std::sqrt(5.0)) * k;
      const Vec3 d(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
      double a_most = -1e9;
      double b_least = 1e9;
      for (const Vec3& vertex : a.vertices) a_most = std::max(a_most, d.dot(vertex));
      for (const Vec3& vertex : b.vertices) b_least = std::min(b_least, d.dot(vertex));
      least = std::min(least, a_most - b_least);
    }
    const double found = penetration(a, b, 0);
    EXPECT_LE(found, std::max(0.0, least) + 1e-14) << pair;
    EXPECT_NEAR(found, std::max(0.0, least), 0.03) << pair;
  }
}

/// Edges of two boxes that touch: an edge along y, sqrt(1/2) to the right of the centre of the left box, and an edge along z.
/// No face of a box separates the boxes.
TEST(Convex, BoxesEdgeToEdge) {
  const double reach = std::sqrt(0.5);
  const Convex left = at(box(1, 8, 1), {0, 0, 0}, Vec3::UnitY(), kPi / 4);
  const auto right = [&](double gap) { return at(box(1, 1, 8), {2 * reach + gap, 0, 0}, Vec3::UnitZ(), kPi / 4); };
  EXPECT_NEAR(penetration(left, right(-0.01), 0), 0.01, 1e-14);
  EXPECT_EQ(penetration(left, right(0.01), 0), 0);
}

TEST(Convex, SpheresWithSpheresFacesEdgesAndCorners) {
  EXPECT_NEAR(penetration(at(ball(1), {1, 2, 3}), at(ball(2), {1, 2, 3}), 0), 3, 1e-15) << "one around the other";
  EXPECT_NEAR(penetration(at(ball(1), {0, 0, 0}), at(ball(2), {1, 2, 2}, Vec3::UnitX(), 1), 0), 0, 1e-15);
  EXPECT_NEAR(penetration(at(ball(1), {0, 0, 0}), at(ball(2), {0.9, 1.8, 1.8}), 0), 0.3, 1e-15);
  EXPECT_NEAR(penetration(at(ball(1), {1.9, 0, 0}), at(box(2, 2, 2), {0, 0, 0}), 0), 0.1, 1e-15);
  // A centre at (1 + d, 1 + d) is sqrt(2) d from the edge.
  EXPECT_NEAR(penetration(at(ball(1), {1.7, 1.7, 0}), at(box(2, 2, 2), {0, 0, 0}), 0), 1 - 0.7 * std::sqrt(2), 1e-14);
  EXPECT_NEAR(penetration(at(ball(1), {1.5, 1.5, 1.5}), at(box(2, 2, 2), {0, 0, 0}), 0), 1 - 0.5 * std::sqrt(3), 1e-14);
  EXPECT_EQ(penetration(at(ball(1), {1.6, 1.6, 1.6}), at(box(2, 2, 2), {0, 0, 0}), 0), 0);
}

/// The half cylinders of two M-TRAN blocks of a module touch at all hinge angles and never overlap.
TEST(Convex, HalfCylindersOfOneModuleTouch) {
  const Shape half{Shape::Kind::half_cylinder, {}, {0.0325, 0.065, 0}};
  for (int tenths = -15; tenths <= 15; ++tenths) {
    const double angle = 0.1 * tenths;
    const Convex left = at(half, {0, 0, 0}, Vec3::UnitY(), angle);
    const Convex right = moved(convex(half), {turn(Vec3::UnitZ(), kPi).toRotationMatrix(), {0.065, 0, 0}});
    EXPECT_LT(penetration(left, right, 0), 1e-15) << angle;
  }
}

/// The axis that separates two boxes still separates them after a small motion, but not if the boxes overlap.
TEST(Convex, TheAxisThatShowsTwoApartServesAgain) {
  const Convex one = convex(box(2, 2, 2));
  const Convex other = convex(box(1, 1, 1));
  const Pose here{turn(Vec3::UnitZ(), 0.3).toRotationMatrix(), {5, 1, 0}};
  const auto there = [&](double gap) { return here * Pose{turn(Vec3::UnitX(), 0.7).toRotationMatrix(), {1.5 + gap, 0, 0}}; };
  Vec3 apart = Vec3::Zero();
  ASSERT_EQ(penetration(moved(one, here), moved(other, there(0.1)), 0, apart), 0);
  EXPECT_NEAR(std::abs(apart.dot(here.R.col(0))), 1, 1e-15);
  EXPECT_NEAR(overlap_along(Extent(one), here, Extent(other), there(0.1), apart), -0.1, 1e-15);
  EXPECT_NEAR(overlap_along(Extent(other), there(0.1), Extent(one), here, apart), -0.1, 1e-15);
  EXPECT_NEAR(overlap_along(Extent(one), here, Extent(other), there(0.01), apart), -0.01, 1e-15);
  EXPECT_NEAR(overlap_along(Extent(one), here, Extent(other), there(-0.02), apart), 0.02, 1e-15);
}

/// The depth equals the least value of the support function of the Minkowski difference, approximated from above by 20 000
/// directions.
TEST(Convex, AgreesWithSampledDirections) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vec = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  const std::vector<Shape> shapes{
      box(1, 0.6, 0.3), {Shape::Kind::cylinder, {}, {0.4, 0.9, 0}}, {Shape::Kind::half_cylinder, {}, {0.5, 0.7, 0}}, ball(0.4)};
  std::vector<Vec3> directions;
  constexpr int kDirections = 20000;
  for (int k = 0; k < kDirections; ++k) {  // directions on a spiral on the sphere
    const double z = 1 - (2.0 * k + 1) / kDirections;
    const double turn = kPi * (3 - std::sqrt(5.0)) * k;
    directions.emplace_back(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
  }
  int met = 0;
  for (std::size_t trial = 0; trial < 60; ++trial) {
    const Convex a = at(shapes[trial % 4], Vec3::Zero(), vec().normalized(), 3 * unit(random));
    const Convex b = at(shapes[trial / 4 % 4], 0.7 * vec(), vec().normalized(), 3 * unit(random));
    double least = 1e9;
    for (const Vec3& d : directions) {
      double high = -1e9;
      double low = 1e9;
      for (const Vec3& v : a.vertices) high = std::max(high, d.dot(v) + a.radius);
      for (const Vec3& v : b.vertices) low = std::min(low, d.dot(v) - b.radius);
      least = std::min(least, high - low);
    }
    const double depth = penetration(a, b, 0);
    met += depth > 0 ? 1 : 0;
    // Every direction is within 0.02 rad of a sample, and the slope of the support function is at most the distance of two
    // vertices, 2.5.
    EXPECT_LE(depth, std::max(least, 0.0) + 1e-12) << trial;
    EXPECT_GE(depth, least - 0.02 * 2.5) << trial;
  }
  EXPECT_GT(met, 20);
  EXPECT_LT(met, 58);
}

}  // namespace
}  // namespace gaitlab::report
