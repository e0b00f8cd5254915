// Volumes, centres and moments of shapes and their unions against closed forms and against numerical integration.
#include "core/model/solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "core/model/hull_shape.h"
#include "tests/labels.h"

namespace gaitlab {
namespace {

constexpr double kSolidPi = std::numbers::pi;
constexpr double kByRounding = 1e-12;  // rounding errors of some ten operations
constexpr double kByBars = 1e-3;       // accuracy that united() promises

Shape box_at(const Vec3& size, const Vec3& at, const Vec3& turned = Vec3::Zero()) {
  return {Shape::Kind::box, {rpy(turned), at}, size};
}
Shape ball_at(double r, const Vec3& at) { return {Shape::Kind::sphere, {Mat3::Identity(), at}, {r, 0, 0}}; }
Shape rod_at(double r, double length, const Vec3& at, const Vec3& turned = Vec3::Zero()) {
  return {Shape::Kind::cylinder, {rpy(turned), at}, {r, length, 0}};
}
Shape half_rod_at(double r, double length, const Vec3& at, const Vec3& turned = Vec3::Zero()) {
  return {Shape::Kind::half_cylinder, {rpy(turned), at}, {r, length, 0}};
}

/// Volume and moments about the origin, from which the closed forms of the tests are added and subtracted.
struct Raw {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  Raw& add(double sign, double v, const Vec3& c, const Vec3& mean_squares) {
    volume += sign * v;
    first += sign * v * c;
    second += sign * v * (Mat3(mean_squares.asDiagonal()) + c * c.transpose());
    return *this;
  }
  Raw& add_box(double sign, const Vec3& size, const Vec3& c) { return add(sign, size.prod(), c, size.cwiseAbs2() / 12); }
};

void expect_solid(const Solid& found, const Raw& raw, double tolerance) {
  const Vec3 centre = raw.first / raw.volume;
  const Mat3 second = raw.second - raw.volume * centre * centre.transpose();
  const double size = std::sqrt(second.trace() / raw.volume);
  EXPECT_NEAR(found.volume / raw.volume, 1, tolerance);
  EXPECT_LT((found.centre - centre).norm(), tolerance * size);
  EXPECT_LT((found.second - second).norm(), tolerance * second.trace());
}

TEST(Solid, OneShape) {
  expect_solid(united({{box_at({1, 2, 3}, {4, 5, 6})}}), Raw().add_box(1, {1, 2, 3}, {4, 5, 6}), kByRounding);
  expect_solid(united({{ball_at(2, {1, 0, 0})}}), Raw().add(1, 32 * kSolidPi / 3, {1, 0, 0}, Vec3::Constant(4.0 / 5)),
               kByRounding);
  expect_solid(united({{rod_at(2, 3, {0, 0, 0})}}), Raw().add(1, 12 * kSolidPi, {0, 0, 0}, {1, 9.0 / 12, 1}), kByRounding);
  const double x = 4 * 2 / (3 * kSolidPi);
  expect_solid(united({{half_rod_at(2, 3, {0, 0, 0})}}), Raw().add(1, 6 * kSolidPi, {x, 0, 0}, {1 - x * x, 0.75, 1}),
               kByRounding);
}

/// The inertia of a cube about its centre is m a^2 / 6 about any axis. That of a rod is from a textbook.
TEST(Solid, InertiaOfAMass) {
  const Mat3 cube = united({{box_at({2, 2, 2}, {1, 2, 3}, {0.3, 0.4, 0.5})}}).inertia(3);
  EXPECT_LT((cube - 2 * Mat3::Identity()).norm(), kByRounding);
  const Mat3 rod = united({{rod_at(0.5, 2, {1, 2, 3}, {kSolidPi / 2, 0, 0})}}).inertia(6);  // along z
  EXPECT_LT((rod - Mat3(Vec3(2.375, 2.375, 0.75).asDiagonal())).norm(), 1e-11);
}

/// The body of the M-TRAN module: a box and a half cylinder that touch, with the numbers of scenarios/modules/mtran.yaml.
TEST(Solid, TouchingShapesAreExact) {
  const Solid block = united({{box_at({0.0325, 0.065, 0.065}, {-0.04875, 0, 0}), half_rod_at(0.0325, 0.065, {-0.0325, 0, 0})}});
  EXPECT_NEAR(block.centre.x(), -0.0355338704148542687, 1e-15);
  const Mat3 inertia = block.inertia(0.16);
  EXPECT_NEAR(inertia(0, 0), 0.00010647139641195444, 1e-17);
  EXPECT_NEAR(inertia(1, 1), 9.880342700618174e-05, 1e-17);
  EXPECT_NEAR(inertia(2, 2), 0.00010499869726089396, 1e-17);
}

TEST(Solid, ShapesApartAreExact) {
  // The planes between the two shapes are not parallel to any of their axes.
  Raw both = Raw().add(1, 4 * kSolidPi / 3, {2, 2, 2}, Vec3::Constant(0.2)).add_box(1, {2, 2, 2}, {0, 0, 0});
  expect_solid(united({{ball_at(1, {2, 2, 2}), box_at({2, 2, 2}, {0, 0, 0})}}), both, kByRounding);
}

TEST(Solid, OverlappingBoxesAreExact) {
  Raw raw;
  raw.add_box(1, {4, 2, 2}, {0, 0, 0}).add_box(1, {2, 2, 4}, {2, 1, 1}).add_box(-1, {1, 1, 2}, {1.5, 0.5, 0});
  // The second box goes from 1 to 3, 0 to 2, -1 to 3; the first to 2, 1, 1.
  expect_solid(united({{box_at({4, 2, 2}, {0, 0, 0}), box_at({2, 2, 4}, {2, 1, 1})}}), raw, kByRounding);
  const Pose turned{rpy({0.3, -0.7, 1.1}), {5, 6, 7}};
  Solid there = united({{Shape{Shape::Kind::box, turned, {4, 2, 2}},
                         Shape{Shape::Kind::box, turned * Pose{Mat3::Identity(), {2, 1, 1}}, {2, 2, 4}}}});
  there.second = turned.R.transpose() * there.second * turned.R;
  there.centre = turned.inverse() * there.centre;
  expect_solid(there, raw, 1e-11);
}

TEST(Solid, InnerShapesCountOnce) {
  const Shape crate = box_at({2, 2, 2}, {0, 0, 0});
  const Raw raw = Raw().add_box(1, {2, 2, 2}, {0, 0, 0});
  for (const Shape& inner : {ball_at(1, {0, 0, 0}), rod_at(0.5, 1, {0.2, 0, 0}, {0.5, 0, 0.5}), crate,
                             box_at({1, 1, 1}, {0, 0, 0}, {0.3, 0.4, 0.5})}) {
    expect_solid(united({{crate, inner}}), raw, kByRounding);
    expect_solid(united({{inner, crate, inner}}), raw, kByRounding);
  }
  expect_solid(united({{ball_at(2, {0, 0, 0}), box_at({1, 1, 1}, {0.5, 0, 0})}}),
               Raw().add(1, 32 * kSolidPi / 3, {0, 0, 0}, Vec3::Constant(0.8)), kByRounding);
}

/// A sphere whose centre is on a face of a box adds half a sphere, whose centre is 3 r / 8 from the face.
TEST(Solid, SphereOnABox) {
  Raw raw = Raw().add_box(1, {4, 4, 4}, {0, 0, 0});
  raw.add(1, 2 * kSolidPi / 3, {2.375, 0, 0}, {0.2 - 0.375 * 0.375, 0.2, 0.2});
  expect_solid(united({{box_at({4, 4, 4}, {0, 0, 0}), ball_at(1, {2, 0, 0})}}), raw, kByBars);
}

/// Two equal cylinders that cross have a Steinmetz solid in common: V = 16 r^3 / 3, int x^2 = 64 r^5 / 45 along both axes, and
/// 16 r^5 / 15 across.
TEST(Solid, CrossingCylinders) {
  Raw raw;
  raw.add(1, 6 * kSolidPi, {0, 0, 0}, {0.25, 3, 0.25}).add(1, 6 * kSolidPi, {0, 0, 0}, {3, 0.25, 0.25});
  raw.add(-1, 16.0 / 3, {0, 0, 0}, {64.0 / 45 / (16.0 / 3), 64.0 / 45 / (16.0 / 3), 0.2});
  const Shape one = rod_at(1, 6, {0, 0, 0});
  const Shape other = rod_at(1, 6, {0, 0, 0}, {0, 0, kSolidPi / 2});
  expect_solid(united({{one, other}}), raw, kByBars);
}

TEST(Solid, CylindersInOneLine) {
  const Raw raw = Raw().add(1, 6 * kSolidPi, {0, 1, 0}, {0.25, 3, 0.25});
  expect_solid(united({{rod_at(1, 4, {0, 0, 0}), rod_at(1, 4, {0, 2, 0})}}), raw, kByBars);
  expect_solid(united({{rod_at(1, 6, {0, 1, 0}), rod_at(1, 6, {0, 1, 0})}}), raw, kByBars);
}

/// True if a point lies in a shape, from the definition of the shape.
bool in_shape(const Shape& shape, const Vec3& point) {
  const Vec3 p = shape.in_body.R.transpose() * (point - shape.in_body.p);
  const Vec3& size = shape.size;
  if (shape.kind == Shape::Kind::box) return (p.cwiseAbs() - size / 2).maxCoeff() <= 0;
  if (shape.kind == Shape::Kind::sphere) return p.norm() <= size.x();
  if (shape.kind == Shape::Kind::hull) {
    return std::ranges::all_of(shape.hull->faces, [&](const Hull::Face& face) { return face.normal.dot(p) <= face.offset; });
  }
  return std::abs(p.y()) <= size.y() / 2 && std::hypot(p.x(), p.z()) <= size.x() &&
         (shape.kind == Shape::Kind::cylinder || p.x() >= 0);
}

Shape random_shape(std::mt19937& random) {
  std::uniform_real_distribution<double> size(0.5, 2);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&](std::uniform_real_distribution<double>& of) {
    const double x = of(random), y = of(random), z = of(random);
    return Vec3(x, y, z);
  };
  const auto kind = static_cast<Shape::Kind>(random() % 5);
  Shape made{kind, {rpy(3 * vector(any)), vector(any)}, vector(size)};
  if (kind != Shape::Kind::hull) return made;
  std::vector<Vec3> points;
  for (int k = 0; k < 16; ++k) points.push_back(vector(any));
  return hull_shape(made.in_body, points).value();
}

/// The faces of a hull are its boundary: no point is outside a face, and each edge of a face is an edge of one other face, in
/// the opposite direction. Then V - E + F = 2 (Euler).
TEST(Hull, RandomPoints) {
  std::mt19937 random(1);
  std::normal_distribution<double> any;
  for (std::size_t n = 4; n <= kMostHullPoints; n += 6) {
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = any(random), y = any(random), z = any(random);
      points.emplace_back(x, y, z);
      if (n % 4 == 2) points.back().normalize();  // on a sphere: every point is a corner
    }
    const Hull hull = convex_hull(points);
    EXPECT_EQ(hull.corners.size() == n, n < 5 || n % 4 == 2) << n;
    std::set<std::pair<std::size_t, std::size_t>> edges;
    for (const Hull::Face& face : hull.faces) {
      EXPECT_NEAR(face.normal.norm(), 1, kByRounding);
      // Points within 1e-9 of the extent of the points, at most 8, count as on a plane.
      for (const Vec3& point : points) EXPECT_LE(face.normal.dot(point), face.offset + 1e-8);
      for (std::size_t k = 0; k < face.corners.size(); ++k) {
        EXPECT_NEAR(face.normal.dot(hull.corners[face.corners[k]]), face.offset, 1e-8);
        EXPECT_TRUE(edges.emplace(face.corners[k], face.corners[(k + 1) % face.corners.size()]).second);
      }
    }
    for (const auto& [from, to] : edges) EXPECT_TRUE(edges.contains({to, from}));
    EXPECT_EQ(hull.corners.size() + hull.faces.size(), edges.size() / 2 + 2);
  }
}

/// The hull of a box has the box's faces and moments, also if points are inside, on its faces and edges, or given twice.
TEST(Hull, OfABox) {
  const Vec3 size(1, 2, 3);
  std::vector<Vec3> points{{0, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {0.5, 1, 1.5}, {0.1, 1, -1.5}};
  for (const Vec3& corner : box_corners(size)) points.push_back(corner);
  const Pose pose{rpy({0.3, 0.4, 0.5}), {4, 5, 6}};
  const Shape shape = hull_shape(pose, points).value();
  EXPECT_EQ(shape.hull->corners.size(), 8U);
  EXPECT_EQ(shape.hull->faces.size(), 6U);
  const Solid box = solid({Shape::Kind::box, pose, size});
  const Solid found = solid(shape);
  EXPECT_NEAR(found.volume, box.volume, kByRounding);
  EXPECT_LT((found.centre - box.centre).norm(), kByRounding);
  EXPECT_LT((found.second - box.second).norm(), kByRounding);
  EXPECT_LT((shape.size - size).norm(), kByRounding);
}

/// Points on the edges of a turned box are on a line with its corners, except for rounding. The hull leaves them out.
TEST(Hull, OfABoxWithPointsOnItsEdges) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-3, 3);
  for (int turned = 0; turned < 20; ++turned) {
    const double roll = any(random), pitch = any(random), yaw = any(random);
    const Mat3 R = rpy({roll, pitch, yaw});
    const std::array<Vec3, 8> corners = box_corners({0.1, 0.2, 0.3});
    std::vector<Vec3> points;
    for (std::size_t a = 0; a < 8; ++a) {
      points.push_back(R * corners[a]);
      for (std::size_t b = a + 1; b < 8; ++b) {
        if (((corners[a] - corners[b]).array() != 0).count() == 1)
          points.push_back(R * Vec3(corners[a] + 0.3 * (corners[b] - corners[a])));
      }
    }
    const Hull hull = convex_hull(points);
    EXPECT_EQ(hull.corners.size(), 8U) << turned;
    EXPECT_EQ(hull.faces.size(), 6U) << turned;
  }
}

/// A tetrahedron with three edges of length a, b, c at right angles has V = a b c / 6, its centre at (a, b, c) / 4, and
/// int x^2 dV = V a^2 / 10, int x y dV = V a b / 20 about the corner.
TEST(Hull, OfATetrahedron) {
  const Vec3 e(1, 2, 3);
  const Solid found = solid(hull_shape({}, std::vector<Vec3>{{0, 0, 0}, {e.x(), 0, 0}, {0, e.y(), 0}, {0, 0, e.z()}}).value());
  EXPECT_NEAR(found.volume, 1, kByRounding);
  EXPECT_LT((found.centre - e / 4).norm(), kByRounding);
  const Mat3 about_corner = Mat3(e.cwiseAbs2().asDiagonal()) / 20 + e * e.transpose() / 20;
  EXPECT_LT((found.second - (about_corner - e * e.transpose() / 16)).norm(), kByRounding);
}

TEST(Hull, NeedsAVolume) {
  EXPECT_FALSE(hull_shape({}, {}));
  EXPECT_FALSE(hull_shape({}, std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_FALSE(hull_shape({}, std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}));
  EXPECT_FALSE(hull_shape({}, std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));
}

const test::Label kAllCells("Solid.UnionsOfRandomShapes", "unsanitized");

/// The reference divides space into 100^3 cells. A cell on the surface is wrong by at most half of its volume, and these errors
/// have both signs.
TEST(Solid, UnionsOfRandomShapes) {
  constexpr int kCells = 100;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<Shape> shapes;
    for (unsigned n = 0; n < 2 + seed % 3; ++n) shapes.push_back(random_shape(random));
    const auto [low, high] = bounds(shapes);
    const Vec3 cell = (high - low) / kCells;
    Raw raw;
    for (int i = 0; i < kCells * kCells * kCells; ++i) {
      const int x = i % kCells;
      const int y = i / kCells % kCells;
      const int z = i / kCells / kCells;
      const Vec3 n(x + 0.5, y + 0.5, z + 0.5);
      const Vec3 p = low + cell.cwiseProduct(n);
      bool in = false;
      for (const Shape& shape : shapes) in = in || in_shape(shape, p);
      if (in) raw.add(1, cell.prod(), p, cell.cwiseAbs2() / 12);
    }
    SCOPED_TRACE(seed);
    expect_solid(united(shapes), raw, 4e-3);
  }
}

/// The signed distance from a convex set is the largest d p - h(d) over unit vectors d, where h(d) = d farthest(d).
TEST(Solid, DistancesFromShapes) {
  constexpr int kDirections = 20000;  // on a spiral of Fibonacci: 0.025 rad apart
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const Shape shape = random_shape(random);
    const Vec3 p = random_shape(random).in_body.p * 2.0;
    double most = -1e9;
    for (int k = 0; k < kDirections; ++k) {
      const double z = 1 - (2 * k + 1.0) / kDirections;
      const double angle = kSolidPi * (3 - std::sqrt(5.0)) * k;
      const Vec3 d(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
      most = std::max(most, d.dot(p - farthest(shape, d)));
    }
    EXPECT_NEAR(distance(shape, p), most, 0.02) << seed;
    EXPECT_GE(distance(shape, p), most - kByRounding) << seed;
    EXPECT_EQ(in_shape(shape, p), distance(shape, p) <= 0) << seed;
  }
}

TEST(Solid, PointsOutsideAHull) {
  const std::vector<Shape> dumbbell{ball_at(1, {-3, 0, 0}), ball_at(1, {3, 0, 0})};
  EXPECT_EQ(outside_hull(dumbbell, {0, 0, 0}), 0);
  EXPECT_EQ(outside_hull(dumbbell, {0, 0.9, 0}), 0) << "between the spheres, in no shape";
  EXPECT_NEAR(outside_hull(dumbbell, {0, 0, 1.5}), 0.5, 0.005);
  EXPECT_NEAR(outside_hull(dumbbell, {10, 0, 0}), 6, 0.06);
  EXPECT_NEAR(outside_hull({{half_rod_at(1, 1, {0, 0, 0})}}, {-0.2, 0, 0}), 0.2, 0.002);
}

}  // namespace
}  // namespace gaitlab
