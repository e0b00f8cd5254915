// A robot seen by a distant camera: outlines of its bodies in the plane of the view.
#pragma once
#include <vector>

#include "core/model/kinematics.h"
#include "core/model/role.h"
#include "report/plot/canvas.h"

namespace gaitlab::report {

/// Unit vectors of a view in world axes: right and up on the paper, and away from the viewer.
struct Camera {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitZ(), away = Vec3::UnitY();
  [[nodiscard]] Point operator()(const Vec3& p) const { return {right.dot(p), up.dot(p)}; }
};

/// Outline of one body: convex polygons, counter-clockwise, m, in the plane of the view.
struct Outline {
  std::vector<Polygon> polygons;
  Role role = Role::other;
  bool far = false;  ///< true if the body is completely behind the robot's centre of mass
};

/// Outlines of all bodies with shapes, from far to near, so that drawing them in this order hides covered parts. The order is
/// by mean depth; at equal depth the body with the nearer front is later.
std::vector<Outline> side_view(const Robot& robot, const Kinematics& kinematics, const Camera& camera = {});

/// Outline of a box that is not part of the robot, seen by the same camera.
Polygon box_outline(const Pose& pose, const Vec3& size, const Camera& camera = {});

/// Convex hull of the points, counter-clockwise, without points on its edges.
Polygon convex_hull(std::vector<Point> points);

}  // namespace gaitlab::report
