// A robot seen by a distant camera: outlines of its bodies in the plane of the view.
#pragma once
#include <vector>

#include "core/model/kinematics.h"
#include "core/model/role.h"
#include "report/plot/canvas.h"

namespace gaitlab::report {

/// Directions of a view, world axes, unit vectors: right and up on the paper, and away from the viewer.
struct Camera {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitZ(), away = Vec3::UnitY();
  [[nodiscard]] Point operator()(const Vec3& p) const { return {right.dot(p), up.dot(p)}; }
};

/// One body: convex polygons, counter-clockwise, m, in the plane of the view.
struct Outline {
  std::vector<Polygon> polygons;
  Role role = Role::other;
  bool far = false;  ///< wholly behind the robot's centre of mass
};

/// One outline per body that has shapes, far to near (by mean depth; at the same depth the body whose front is nearer comes
/// later), so that drawing them in this order hides covered parts.
std::vector<Outline> side_view(const Robot& robot, const Kinematics& kinematics, const Camera& camera = {});

/// Outline of a box that is not part of the robot, from the same side.
Polygon box_outline(const Pose& pose, const Vec3& size, const Camera& camera = {});

/// The convex hull, counter-clockwise, without points on its edges.
Polygon convex_hull(std::vector<Point> points);

}  // namespace gaitlab::report
