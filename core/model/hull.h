// Convex polyhedra: the hull of a few points, with its faces.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/model/frames.h"

namespace gaitlab {

/// Largest number of points of a hull. The time for its faces grows with the fourth power of the number: 1 ms for 32 points.
inline constexpr std::size_t kMostHullPoints = 64;

/// A convex polyhedron, m.
struct Hull {
  /// Plane polygon on the surface.
  struct Face {
    Vec3 normal;                       ///< outward unit vector
    double offset;                     ///< m; normal . p = offset on the face
    std::vector<std::size_t> corners;  ///< indices, counter-clockwise as seen from outside
  };
  std::vector<Vec3> corners;
  std::vector<Face> faces;

  /// Farthest corner in direction d.
  [[nodiscard]] const Vec3& farthest(const Vec3& d) const;
  /// Distance of a point from the surface, negative inside.
  [[nodiscard]] double distance(const Vec3& point) const;
};

/// Convex hull of at most 64 points: every plane through three of them on one side of which all others are is a face. Points
/// within 1e-9 of the points' extent of a plane are on it. Points that are not corners are left out. The result is empty if
/// all points are in a plane.
Hull convex_hull(std::span<const Vec3> points);

}  // namespace gaitlab
