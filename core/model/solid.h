// Solids of shapes: volume, centre and inertia at uniform density, and distances from their surfaces.
#pragma once
#include <array>
#include <span>
#include <utility>

#include "core/model/module_type.h"

namespace gaitlab {

/// The 8 corners of a box about the origin with these edges. The sign of x changes fastest.
std::array<Vec3, 8> box_corners(const Vec3& edges);

/// Moments of a solid: volume V, m^3; centre c = (1/V) int p dV, m; second moments int (p - c)(p - c)^T dV about the centre,
/// m^5.
struct Solid {
  double volume = 0;
  Vec3 centre = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  /// Inertia about the centre of a body with this mass (kg) at uniform density, kg m^2: (m/V) (tr(S) 1 - S).
  [[nodiscard]] Mat3 inertia(double mass) const { return mass / volume * (second.trace() * Mat3::Identity() - second); }
  /// Adds a solid that does not overlap this one (parallel axes).
  void add(const Solid& other);
};

/// Solid of one shape in body axes, in closed form. A half cylinder has V = pi r^2 L / 2 and its centre at x = 4 r / (3 pi).
Solid solid(const Shape& shape);

/// Largest number of shapes of a body for united(), which takes 10 ms for a few overlapping shapes and 0.1 s for 100.
inline constexpr std::size_t kMostShapes = 100;

/// Solid of the union of shapes, in body axes. The result is exact (rounding aside) for shapes that do not overlap, for shapes
/// within a box, and for overlapping boxes with common axes. Other overlapping shapes are cut into about 256 x 256 bars along
/// the z axis of the largest of them, each with the length of the union on the bar's middle line. The error of volume and
/// moments is then below 0.1 %. The result is deterministic.
Solid united(std::span<const Shape> shapes);

/// Farthest point of a shape in direction d (of any length > 0), body axes.
Vec3 farthest(const Shape& shape, const Vec3& d);
/// Least and largest coordinates of the shapes in body axes, m. There must be at least one shape.
std::pair<Vec3, Vec3> bounds(std::span<const Shape> shapes);
/// Distance of a point (body axes) from the surface of a shape, m, negative inside.
double distance(const Shape& shape, const Vec3& point);
/// Least distance of a point from the shapes, m; negative within a shape.
double distance(std::span<const Shape> shapes, const Vec3& point);
/// Lower bound of the distance of a point from the convex hull of the shapes, m, at least 0. It is 0 for points in the hull,
/// and is at most 1 % less than the distance for points outside (Frank-Wolfe: Jaggi, ICML 2013).
double outside_hull(std::span<const Shape> shapes, const Vec3& point);

}  // namespace gaitlab
