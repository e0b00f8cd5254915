// Shapes of bodies as convex polyhedra, and their penetration.
#pragma once
#include <utility>
#include <vector>

#include "core/model/module_type.h"

namespace gaitlab::report {

/// A convex polyhedron, or a sphere around its only vertex. Round shapes are inscribed prisms of 24 sides: at most 0.9 % of the
/// radius is missing.
struct Convex {
  std::vector<Vec3> vertices;    ///< m
  std::vector<Vec3> normals;     ///< of the faces, unit, one of each opposite pair
  std::vector<Vec3> directions;  ///< of the edges, unit, one for all parallel ones
  double radius = 0;             ///< m, of the sphere
};

/// Convex of a shape, in the frame of its body.
Convex convex(const Shape& shape);
Convex moved(const Convex& local, const Pose& pose);
/// The same at a pose, written into `there`, which an earlier call has sized.
void move(const Convex& local, const Pose& pose, Convex& there);

/// Shortest translation that separates the two, m; 0 if they are apart or the translation is at most `ignored`. Separating axis
/// theorem: the smallest overlap over the faces' normals and the products of edges (Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH
/// 1996, section 5); for a sphere over the directions from its centre to faces, edges and vertices. `apart`: if the result is
/// 0, the separating axis, unit.
double penetration(const Convex& a, const Convex& b, double ignored, Vec3& apart);
double penetration(const Convex& a, const Convex& b, double ignored);

/// Extent of a convex along any axis, in its frame: computed from the midpoints of its vertices if these are pairs along one
/// line.
class Extent {
 public:
  explicit Extent(const Convex& of);
  /// Least and largest coordinate, m.
  [[nodiscard]] std::pair<double, double> along(const Vec3& axis) const;

 private:
  std::vector<Vec3> middles_ = {};
  Vec3 half_ = Vec3::Zero();  ///< from a midpoint to one end
  double radius_;
};

/// Overlap of two convexes at these poses along a unit axis, m; negative: gap. An upper bound of their penetration. Needs no
/// move.
double overlap_along(const Extent& a, const Pose& a_place, const Extent& b, const Pose& b_place, const Vec3& axis);

}  // namespace gaitlab::report
