#include "report/side_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace gaitlab::report {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kRoundSegments = 24;  // of a full circle: a half cylinder has 12

// Points in the shape's frame whose hull is the shape, or close to it.
std::vector<Vec3> vertices(const Shape& shape) {
  std::vector<Vec3> points;
  if (shape.kind == Shape::Kind::box) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5, (corner & 4) != 0 ? 0.5 : -0.5);
      points.push_back(sign.cwiseProduct(shape.size));
    }
    return points;
  }
  const bool half = shape.kind == Shape::Kind::half_cylinder;
  const double radius = shape.size.x();
  for (int k = 0; k <= (half ? kRoundSegments / 2 : kRoundSegments); ++k) {
    const double angle = 2 * kPi * k / kRoundSegments - kPi / 2;  // a half cylinder goes through +x
    for (const double side : {-0.5, 0.5})
      points.emplace_back(radius * math::cos(angle), side * shape.size.y(), radius * math::sin(angle));
  }
  return points;
}

// A sphere's picture is a circle whichever way its body is turned.
std::vector<Vec3> world_vertices(const Shape& shape, const Pose& body, const Camera& camera) {
  const Pose pose = body * shape.in_body;
  std::vector<Vec3> points;
  if (shape.kind == Shape::Kind::sphere) {
    for (const Vec3& p : vertices({Shape::Kind::cylinder, {}, {shape.size.x(), 2 * shape.size.x(), 0}}))
      points.push_back(pose.p + p.x() * camera.right + p.y() * camera.away + p.z() * camera.up);
  } else {
    for (const Vec3& p : vertices(shape)) points.push_back(pose * p);
  }
  return points;
}

Role role_of(const ModuleType& type, std::size_t body) {
  for (const FaceType& face : type.faces) {
    if (face.body == body) return face.gender == Gender::active ? Role::active : Role::passive;
  }
  return Role::link;
}

// Bodies of a planar robot differ in depth by rounding only, and must not change places for it from picture to picture.
double rounded_depth(double depth) { return std::round(depth * 1e4); }

struct Seen {
  Outline outline;
  double mean = 0, front = 0;  // depth
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

double cross(Point o, Point a, Point b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

}  // namespace

Polygon convex_hull(std::vector<Point> points) {
  // Andrew's monotone chain: the lower hull from left to right, then the upper one back.
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  if (points.size() < 3) return points;
  Polygon hull;
  const auto add = [&hull](Point p, std::size_t fixed) {
    while (hull.size() >= fixed + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Point& point : points) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

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
  std::vector<Outline> outlines;
  outlines.reserve(seen.size());
  for (Seen& each : seen) outlines.push_back(std::move(each.outline));
  return outlines;
}

}  // namespace gaitlab::report
