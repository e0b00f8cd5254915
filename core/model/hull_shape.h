// Shapes of convex hulls, and their moments.
#pragma once
#include <optional>
#include <span>

#include "core/model/module_type.h"
#include "core/model/solid.h"

namespace gaitlab {

/// Shape of the convex hull of at most 64 points, in their frame at `in_body`; nothing if the points are in a plane.
std::optional<Shape> hull_shape(const Pose& in_body, std::span<const Vec3> points);

/// Solid of a hull about the origin of its axes, as the sum of tetrahedra between the origin and the triangles of its faces. A
/// tetrahedron with corners 0, a, b, c has the volume V = a . (b x c) / 6 and int p p^T dV = V/20 (sum of p p^T over a, b, c
/// and s = a + b + c).
Solid solid(const Hull& hull);

}  // namespace gaitlab
