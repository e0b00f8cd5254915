#include "report/analysis/convex.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/math/functions.h"
#include "core/model/solid.h"

namespace gaitlab::report {

namespace {

constexpr int kRoundSegments = 24;  // segments of a full circle; a half cylinder has 12
constexpr double kNoAxis = 1e-9;    // length of a cross product below which two edges are parallel

Convex block(const Vec3& size) {
  Convex made;
  const std::array<Vec3, 8> corners = box_corners(size);
  made.vertices.assign(corners.begin(), corners.end());
  made.normals = made.directions = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  return made;
}

/// Prism with axis y. A half prism is on the side of +x.
Convex prism(double radius, double length, bool half) {
  Convex made;
  const int sides = half ? kRoundSegments / 2 : kRoundSegments;
  std::vector<Vec3> round;
  for (int k = 0; k <= sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRoundSegments - std::numbers::pi / 2;
    round.emplace_back(radius * math::cos(angle), 0, radius * math::sin(angle));
    for (const double side : {-0.5, 0.5}) made.vertices.push_back(round.back() + side * length * Vec3::UnitY());
  }
  made.normals = made.directions = {Vec3::UnitY()};
  if (half) round.push_back(round.front());
  // The edges of the second half of a full circle are parallel to the first.
  const std::size_t edges = half ? round.size() - 1 : kRoundSegments / 2;
  for (std::size_t k = 0; k < edges; ++k) {
    made.directions.push_back((round[k + 1] - round[k]).normalized());
    made.normals.push_back(made.directions.back().cross(Vec3::UnitY()));
  }
  return made;
}

/// Least and largest coordinate of a convex polyhedron or sphere along a unit axis.
std::pair<double, double> range(const Convex& of, const Vec3& axis) {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -lo;
  for (const Vec3& vertex : of.vertices) {
    const double at = axis.dot(vertex);
    lo = std::min(lo, at);
    hi = std::max(hi, at);
  }
  return {lo - of.radius, hi + of.radius};
}

/// Smallest overlap of two convexes along the axes tested so far; 0 if an axis separates them or nearly does.
class Overlap {
 public:
  Overlap(const Convex& a, const Convex& b, double ignored) : a_(a), b_(b), ignored_(ignored) {}

  /// Tests an axis. Returns false if no further axis is needed.
  bool along(const Vec3& direction) {
    const double length = direction.norm();
    if (length < kNoAxis) return true;
    axis_ = direction / length;
    const auto [a_lo, a_hi] = range(a_, axis_);
    const auto [b_lo, b_hi] = range(b_, axis_);
    least_ = std::min({least_, a_hi - b_lo, b_hi - a_lo});
    return least_ > ignored_;
  }
  [[nodiscard]] double depth() const { return least_ > ignored_ ? least_ : 0; }
  [[nodiscard]] const Vec3& axis() const { return axis_; }  ///< axis that was tested last

 private:
  const Convex& a_;
  const Convex& b_;
  double ignored_, least_ = std::numeric_limits<double>::infinity();
  Vec3 axis_ = Vec3::Zero();
};

bool apart_from_sphere(Overlap& overlap, const Convex& sphere, const Convex& other) {
  for (const Vec3& vertex : other.vertices) {
    Vec3 way = vertex - sphere.vertices.front();
    if (way.norm() < kNoAxis) way = Vec3::UnitX();  // the centre coincides with the vertex: every direction is equally short
    if (!overlap.along(way)) return true;
    for (const Vec3& edge : other.directions) {
      if (!overlap.along(way - edge * edge.dot(way))) return true;
    }
  }
  return false;
}

/// Tests all axes. Returns false at the first separating axis.
bool overlap_everywhere(Overlap& overlap, const Convex& a, const Convex& b) {
  for (const Convex* of : {&a, &b}) {
    for (const Vec3& normal : of->normals) {
      if (!overlap.along(normal)) return false;
    }
  }
  if (a.radius > 0 && apart_from_sphere(overlap, a, b)) return false;
  if (b.radius > 0 && apart_from_sphere(overlap, b, a)) return false;
  for (const Vec3& first : a.directions) {
    for (const Vec3& second : b.directions) {
      if (!overlap.along(first.cross(second))) return false;
    }
  }
  return true;
}

/// Adds a unit vector, unless it is parallel to one of those that there are.
void add_direction(std::vector<Vec3>& all, const Vec3& one) {
  if (std::ranges::none_of(all, [&](const Vec3& other) { return other.cross(one).norm() < kNoAxis; })) all.push_back(one);
}

Convex polyhedron(const Hull& hull) {
  Convex made{hull.corners, {}, {}};
  for (const Hull::Face& face : hull.faces) {
    add_direction(made.normals, face.normal);
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const Vec3& next = hull.corners[face.corners[(k + 1) % face.corners.size()]];
      add_direction(made.directions, (next - hull.corners[face.corners[k]]).normalized());
    }
  }
  return made;
}

}  // namespace

Convex convex(const Shape& shape) {
  switch (shape.kind) {
    case Shape::Kind::box:
      return moved(block(shape.size), shape.in_body);
    case Shape::Kind::sphere:
      return {{shape.in_body.p}, {}, {}, shape.size.x()};
    case Shape::Kind::hull:
      return moved(polyhedron(*shape.hull), shape.in_body);
    default:
      return moved(prism(shape.size.x(), shape.size.y(), shape.kind == Shape::Kind::half_cylinder), shape.in_body);
  }
}

void move(const Convex& local, const Pose& pose, Convex& there) {
  for (std::size_t i = 0; i < local.vertices.size(); ++i) there.vertices[i] = pose * local.vertices[i];
  for (std::size_t i = 0; i < local.normals.size(); ++i) there.normals[i] = pose.R * local.normals[i];
  for (std::size_t i = 0; i < local.directions.size(); ++i) there.directions[i] = pose.R * local.directions[i];
}

Convex moved(const Convex& local, const Pose& pose) {
  Convex there = local;
  move(local, pose, there);
  return there;
}

double penetration(const Convex& a, const Convex& b, double ignored) {
  Vec3 apart;
  return penetration(a, b, ignored, apart);
}

double penetration(const Convex& a, const Convex& b, double ignored, Vec3& apart) {
  Overlap overlap(a, b, ignored);
  if (overlap_everywhere(overlap, a, b)) return overlap.depth();
  apart = overlap.axis();
  return 0;
}

Extent::Extent(const Convex& of) : radius_(of.radius) {
  const std::vector<Vec3>& v = of.vertices;
  const Vec3 drawn = v.size() % 2 == 0 && !v.empty() ? Vec3(v[1] - v[0]) : Vec3(Vec3::Zero());
  bool all = v.size() % 2 == 0;
  for (std::size_t k = 0; k + 1 < v.size() && all; k += 2) all = (v[k + 1] - v[k] - drawn).norm() < kNoAxis * drawn.norm();
  for (std::size_t k = 0; k < v.size(); k += all ? 2 : 1) middles_.push_back(all ? Vec3(v[k] + 0.5 * drawn) : v[k]);
  if (all) half_ = 0.5 * drawn;
}

std::pair<double, double> Extent::along(const Vec3& axis) const {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -lo;
  for (const Vec3& middle : middles_) {
    const double at = axis.dot(middle);
    lo = std::min(lo, at);
    hi = std::max(hi, at);
  }
  const double more = radius_ + std::abs(axis.dot(half_));
  return {lo - more, hi + more};
}

double overlap_along(const Extent& a, const Pose& a_place, const Extent& b, const Pose& b_place, const Vec3& axis) {
  const auto [a_lo, a_hi] = a.along(a_place.R.transpose() * axis);
  const auto [b_lo, b_hi] = b.along(b_place.R.transpose() * axis);
  const double way = axis.dot(b_place.p - a_place.p);
  return std::min(a_hi - b_lo - way, b_hi - a_lo + way);
}

}  // namespace gaitlab::report
