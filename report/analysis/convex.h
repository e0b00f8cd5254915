// The shapes of bodies as convex polyhedra, and how far two of them are in one another.
#pragma once
#include <vector>

#include "core/model/module_type.h"

namespace gaitlab::report {

/// A convex polyhedron, or a sphere around its only vertex. Round shapes are prisms of 24 sides inscribed in them: at most 0.9
/// % of their radius is missing.
struct Convex {
  std::vector<Vec3> vertices;    ///< m
  std::vector<Vec3> normals;     ///< of the faces, unit, one of each two that are opposite
  std::vector<Vec3> directions;  ///< of the edges, unit, one of all that are parallel
  double radius = 0;             ///< m, of the sphere
};

/// In the frame of the shape's body.
Convex convex(const Shape& shape);
Convex moved(const Convex& local, const Pose& pose);
/// The same into `there`, which has been moved before.
void move(const Convex& local, const Pose& pose, Convex& there);

/// m: the shortest way that takes one out of the other; 0 where they are apart, and where the way is `ignored` or less.
/// Separating axis theorem: the smallest overlap over the faces' normals and the products of edges (Gottschalk, Lin, Manocha,
/// OBBTree, SIGGRAPH 1996, section 5); of a sphere over the ways from its centre to faces, edges and vertices.
/// `apart`: where the way is 0, the axis that shows it, unit.
double penetration(const Convex& a, const Convex& b, double ignored, Vec3& apart);
double penetration(const Convex& a, const Convex& b, double ignored);

/// Whether two in these places overlap by `ignored` or less along an axis: then their penetration is 0. Needs no move.
bool are_apart(const Convex& a, const Pose& a_place, const Convex& b, const Pose& b_place, const Vec3& axis, double ignored);

}  // namespace gaitlab::report
