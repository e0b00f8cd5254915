#include "report/figures/run/side_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/math/convex_hull.h"
#include "report/analysis/convex.h"

namespace gaitlab::report {

namespace {

// Vertices of a shape in the world. A sphere becomes a circle in the plane of the view.
std::vector<Vec3> world_vertices(const Shape& shape, const Pose& body, const Camera& camera) {
  if (shape.kind != Shape::Kind::sphere) return moved(convex(shape), body).vertices;
  const double radius = shape.size.x();
  std::vector<Vec3> points;
  for (const Vec3& p : convex({Shape::Kind::cylinder, {}, {radius, 2 * radius, 0}}).vertices)
    points.push_back(body * shape.in_body.p + p.x() * camera.right + p.y() * camera.away + p.z() * camera.up);
  return points;
}

// Depth rounded to 0.1 mm. The depths of bodies of a planar robot differ only by rounding, which must not change their order
// from view to view.
double rounded_depth(double depth) { return std::round(depth * 1e4); }

struct Seen {
  Outline outline;
  double mean = 0, front = 0;  // m, depths
};

Seen see(const std::vector<Shape>& shapes, const Pose& pose, Role role, const Camera& camera) {
  Seen seen;
  seen.outline.role = role;
  double sum = 0;
  double front = std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  for (const Shape& shape : shapes) {
    std::vector<Point> flat;
    for (const Vec3& p : world_vertices(shape, pose, camera)) {
      const double depth = camera.away.dot(p);
      flat.push_back(camera(p));
      sum += depth;
      front = std::min(front, depth);
      ++count;
    }
    seen.outline.polygons.push_back(convex_hull(std::move(flat)));
  }
  seen.mean = rounded_depth(sum / static_cast<double>(count));
  seen.front = rounded_depth(front);
  return seen;
}

}  // namespace

Polygon convex_hull(std::vector<Point> points) { return math::convex_hull(std::move(points)); }

Polygon box_outline(const Pose& pose, const Vec3& size, const Camera& camera) {
  std::vector<Point> flat;
  for (const Vec3& p : world_vertices({Shape::Kind::box, {}, size}, pose, camera)) flat.push_back(camera(p));
  return convex_hull(std::move(flat));
}

std::vector<Outline> side_view(const Robot& robot, const Kinematics& kinematics, const Camera& camera) {
  std::vector<Seen> seen;
  for (const Body& body : robot.bodies) {
    const ModuleType& type = robot.types[robot.modules[body.module].type];
    const std::vector<Shape>& shapes = type.bodies[body.type].shapes;
    if (shapes.empty()) continue;
    const Pose link{kinematics.R[body.link], kinematics.p[body.link]};
    seen.push_back(see(shapes, link * body.in_link, role_of(type, body.type), camera));
  }
  std::stable_sort(seen.begin(), seen.end(),
                   [](const Seen& a, const Seen& b) { return std::tie(a.front, a.mean) > std::tie(b.front, b.mean); });
  const double middle = rounded_depth(camera.away.dot(sums(robot, kinematics, Vec3::Zero()).com));
  std::vector<Outline> outlines;
  outlines.reserve(seen.size());
  for (Seen& each : seen) {
    each.outline.far = each.front > middle;
    outlines.push_back(std::move(each.outline));
  }
  return outlines;
}

}  // namespace gaitlab::report
