// Convex polyhedra that represent the shapes of bodies, and their penetration.
#pragma once
#include <utility>
#include <vector>

#include "core/model/module_type.h"

namespace gaitlab::report {

/// A convex polyhedron, or a sphere around a single vertex. A round shape becomes an inscribed prism of 24 sides, which is at
/// most 0.9 % of the radius inside the shape.
struct Convex {
  std::vector<Vec3> vertices;    ///< m, corners, or the centre of a sphere
  std::vector<Vec3> normals;     ///< unit normals of the faces, one for each pair of opposite faces
  std::vector<Vec3> directions;  ///< unit directions of the edges, one for all parallel edges
  double radius = 0;             ///< m, radius of a sphere; 0 for a polyhedron
};

/// Polyhedron or sphere of a shape, in the frame of its body.
Convex convex(const Shape& shape);
Convex moved(const Convex& local, const Pose& pose);
/// As moved(), but written into `there`, which must already have the size of `local`.
void move(const Convex& local, const Pose& pose, Convex& there);

/// Length of the shortest translation that separates two convexes, m; 0 if they do not overlap or the length is at most
/// `ignored`. Computed by the separating axis theorem: smallest overlap along the normals of faces and the cross products of
/// edges (Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996, section 5), or for a sphere along the directions from its centre to
/// faces, edges and vertices. If the result is 0, `apart` receives the separating axis (a unit vector).
double penetration(const Convex& a, const Convex& b, double ignored, Vec3& apart);
double penetration(const Convex& a, const Convex& b, double ignored);

/// Extent of a convex along any axis. If the vertices form pairs with equal connecting vectors, it is computed from the
/// midpoints of the pairs, because these are half as many.
class Extent {
 public:
  explicit Extent(const Convex& of);
  /// Least and largest coordinate along a unit axis, m, in the frame of the convex.
  [[nodiscard]] std::pair<double, double> along(const Vec3& axis) const;

 private:
  std::vector<Vec3> middles_ = {};
  Vec3 half_ = Vec3::Zero();  ///< vector from the midpoint of a pair to one of its vertices
  double radius_;
};

/// Overlap of two convexes at these poses along a unit axis, m; negative for a gap. It is an upper bound of their penetration,
/// and does not require moved copies.
double overlap_along(const Extent& a, const Pose& a_place, const Extent& b, const Pose& b_place, const Vec3& axis);

}  // namespace gaitlab::report
