// A robot seen from its right side: outlines of its bodies in the world's x-z plane.
#pragma once
#include <vector>

#include "core/model/kinematics.h"
#include "report/svg.h"

namespace gaitlab::report {

/// What a body is to the eye: the block that carries the active or the passive faces, or the link between them.
enum class Role { active, link, passive, other };

/// One body: convex polygons, counter-clockwise, m; x is the world's x, y the world's z.
struct Outline {
  std::vector<Polygon> polygons;
  Role role = Role::other;
};

/// One outline a body that has shapes, far to near for a viewer at -y who looks towards +y (by mean y; at the same depth the
/// body whose front is nearer comes later), so that drawing them in this order covers what is hidden. Role: the gender of the
/// body's first face, link without faces.
std::vector<Outline> side_view(const Robot& robot, const Kinematics& kinematics);

/// A box that belongs to no robot, from the same side.
Polygon box_outline(const Pose& pose, const Vec3& size);

/// The convex hull, counter-clockwise, without points on its edges.
Polygon convex_hull(std::vector<Point> points);

}  // namespace gaitlab::report
