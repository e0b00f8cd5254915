// Meshes of shapes are closed, their normals point outwards, and their volumes equal those of the shapes. Meshes of the ground
// coincide with the ground.
#include "interchange/mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace gaitlab::interchange {
namespace {

constexpr double kRounding = 1e-15;  // m^3, m^2; rounding errors of some thousand triangles, 1e-17 each

struct Sums {
  double volume = 0;
  Vec3 area = Vec3::Zero();  ///< sum of the area vectors of all triangles, 0 for a closed surface
};

/// Volume and area of a mesh. Fails if the cosine between the normal of a triangle and a normal at its corner is below `bent`.
Sums sums_of(const Mesh& mesh, double bent) {
  Sums sums;
  EXPECT_EQ(mesh.places.size(), mesh.normals.size());
  for (const Vec3& n : mesh.normals) EXPECT_NEAR(n.norm(), 1, 1e-12);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3& a = mesh.places[mesh.triangles[i]];
    const Vec3& b = mesh.places[mesh.triangles[i + 1]];
    const Vec3& c = mesh.places[mesh.triangles[i + 2]];
    const Vec3 area = 0.5 * (b - a).cross(c - a);
    EXPECT_GT(area.norm(), 0) << "a triangle without area";
    for (std::size_t k = i; k < i + 3; ++k) EXPECT_GT(area.normalized().dot(mesh.normals[mesh.triangles[k]]), bent);
    sums.area += area;
    sums.volume += a.dot(area) / 3;  // divergence theorem
  }
  return sums;
}

const Pose kAnywhere{rpy({0.3, -0.7, 1.9}), {0.2, -0.1, 0.4}};

Mesh mesh_of(Shape::Kind kind, const Vec3& size) {
  Mesh mesh;
  add(mesh, {kind, kAnywhere, size});
  return mesh;
}

TEST(Mesh, ShapesAreClosedFaceOutwardsAndHaveTheirVolumes) {
  const double r = 0.1;
  const double circle = 16 * r * r * std::sin(std::numbers::pi / 16);  // area of a regular polygon with 32 corners
  const double flat = 1 - 1e-12;
  const double side = std::cos(std::numbers::pi / 32) - 1e-12;  // cosine of half the angle between two sides
  const auto check = [](const Sums& sums, double volume) {
    EXPECT_NEAR(sums.volume, volume, kRounding);
    EXPECT_LT(sums.area.norm(), kRounding);
  };
  check(sums_of(mesh_of(Shape::Kind::box, {0.3, 0.2, 0.1}), flat), 0.006);
  check(sums_of(mesh_of(Shape::Kind::cylinder, {r, 0.5, 0}), side), 0.5 * circle);
  check(sums_of(mesh_of(Shape::Kind::half_cylinder, {r, 0.5, 0}), side), 0.25 * circle);
  const Sums ball = sums_of(mesh_of(Shape::Kind::sphere, {r, 0, 0}), std::cos(std::numbers::pi / 16));
  EXPECT_LT(ball.area.norm(), kRounding);
  const double whole = 4.0 / 3 * std::numbers::pi * r * r * r;
  EXPECT_LT(ball.volume, whole);
  EXPECT_GT(ball.volume, 0.98 * whole) << "three facets of 0.5 % each";
}

TEST(Mesh, HalfCylindersBulgeTowardsX) {
  Mesh mesh;
  add(mesh, {Shape::Kind::half_cylinder, {}, {0.1, 0.4, 0}});
  double largest = 0;
  for (const Vec3& p : mesh.places) {
    EXPECT_GE(p.x(), -kRounding);
    EXPECT_NEAR(std::abs(p.y()), 0.2, kRounding);
    largest = std::max(largest, p.x());
  }
  EXPECT_NEAR(largest, 0.1, kRounding);
}

/// Meshes of the light and of the dark tiles. Fails if the colour of a tile does not follow from its position in the world.
std::array<Mesh, 2> both_kinds(const Tiles& made) {
  std::array<Mesh, 2> both{made.light, made.light};
  both[1].triangles = made.dark;
  for (std::size_t kind = 0; kind < 2; ++kind) {
    const Mesh& one = both[kind];
    EXPECT_FALSE(one.triangles.empty());
    for (std::size_t i = 0; i < one.triangles.size(); i += 3) {
      Vec3 middle = Vec3::Zero();
      for (std::size_t k = i; k < i + 3; ++k) middle += one.places[one.triangles[k]] / 3;
      const double number = std::floor(middle.x() / made.edge) + std::floor(middle.y() / made.edge);
      EXPECT_EQ(std::fmod(number, 2) != 0, kind == 1);
    }
  }
  return both;
}

TEST(Mesh, TilesCoverTheAreaInStepsOfOneTwoOrFive) {
  for (const Area& area : {Area{-1.3, 2.7, -0.4, 0.4}, Area{0, 0.01, 0, 0.01}, Area{-900, 1e5, 3, 4}}) {
    const Tiles made = tiles(area);
    const double digits = made.edge / std::pow(10.0, std::floor(std::log10(made.edge) + 1e-9));
    EXPECT_LT(std::min({std::abs(digits - 1), std::abs(digits - 2), std::abs(digits - 5)}), 1e-9) << made.edge;
    const double length = std::max(area.x_hi - area.x_lo, area.y_hi - area.y_lo);
    EXPECT_LE(length / made.edge, 40);
    EXPECT_GT(length / made.edge, 15);  // at least about 40 / 2.5 tiles
    Area covered{1e9, -1e9, 1e9, -1e9};
    for (const Vec3& p : made.light.places) {
      covered = {std::min(covered.x_lo, p.x()), std::max(covered.x_hi, p.x()), std::min(covered.y_lo, p.y()),
                 std::max(covered.y_hi, p.y())};
      EXPECT_EQ(p.z(), 0);
    }
    EXPECT_LE(covered.x_lo, area.x_lo);
    EXPECT_GE(covered.x_hi, area.x_hi);
    EXPECT_LE(covered.y_lo, area.y_lo);
    EXPECT_GE(covered.y_hi, area.y_hi);
    for (const Mesh& one : both_kinds(made)) sums_of(one, 1 - 1e-12);
  }
}

TEST(Mesh, TilesLieOnTheHeightfieldAndReachOverTheArea) {
  const Heightfield field{{0.1, -0.2, 0.05}, 0.1, 4, {0, 0.02, -0.01, 0.03, 0.01, 0, 0.02, 0.01, 0.02, 0.01, 0, 0.04}};
  const Tiles made = tiles(field, {-1, 0.3, -0.1, 2});
  EXPECT_DOUBLE_EQ(made.edge, 0.1) << "2.2 m";
  std::set<double> xs;
  std::set<double> ys;
  for (const Vec3& p : made.light.places) {
    EXPECT_EQ(p.z(), field.at(p.x(), p.y()).z);
    xs.insert(p.x());
    ys.insert(p.y());
  }
  EXPECT_EQ(xs.size(), 3 * 4 + 11 + 1U)
      << "cells in four, of which every fourth line is a tile's, too; 1.1 m of tiles beside them";
  EXPECT_EQ(ys.size(), 2 * 4 + 20 + 1U);
  EXPECT_EQ(*xs.begin(), -1);
  EXPECT_NEAR(*xs.rbegin(), 0.4, kRounding);
  EXPECT_NEAR(*ys.begin(), -0.2, kRounding);
  EXPECT_EQ(*ys.rbegin(), 2);
  for (const Vec3& n : made.light.normals) EXPECT_GT(n.z(), std::cos(std::numbers::pi / 6));
  for (const Mesh& one : both_kinds(made)) sums_of(one, 0.5);  // angles between normals are at most twice 30 degrees
}

// The mesh of a large heightfield contains only one height of several. (A mesh of 4096 x 4096 heights would have half a
// gigabyte.)
TEST(Mesh, OfALargeHeightfieldOneHeightOfEveryFewIsDrawn) {
  Heightfield field{{1, 2, 0}, 0.1, 1101, {}};
  std::vector<double> heights;
  for (std::size_t i = 0; i < 1101UL * 900UL; ++i) heights.push_back(1e-3 * static_cast<double>(i % 1101));
  field.values = std::move(heights);
  EXPECT_EQ(drawn_stride(field), 2U);
  const Tiles made = tiles(field, {2, 3, 3, 4});
  std::set<double> xs;
  for (const Vec3& p : made.light.places) {
    EXPECT_EQ(p.z(), field.at(p.x(), p.y()).z);
    xs.insert(p.x());
  }
  EXPECT_NEAR(static_cast<double>(xs.size()), 551, 551 / 10.0) << "and tiles";
  EXPECT_NEAR(*xs.begin(), 1, kRounding);
  EXPECT_NEAR(*xs.rbegin(), 111, kRounding);
  field.columns = 2;  // long field with few heights
  field.values = Heights(std::vector<double>(2UL * 600UL));
  EXPECT_EQ(drawn_stride(field), 1U);
}

}  // namespace
}  // namespace gaitlab::interchange
