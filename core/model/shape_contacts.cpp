#include "core/model/shape_contacts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/solid.h"

namespace gaitlab {

namespace {

// Tolerances for frames written by hand: two equal edges must count as one if pi is written as 3.1416.
constexpr double kOnePlace = 1e-3;  // for elements at one place or on a surface, as a share of the size of a body
constexpr double kOnAxis = 1e-3;    // sine of an angle, and a distance as a share of a radius

/// `n` points of a circle with axis y in steps of 45 degrees from number `first` on. Number 0 is at +x, number 2 at -z.
void add_arc(double r, double y, int first, int n, std::vector<Vec3>& points) {
  constexpr double kHalf = 0.5 * std::numbers::sqrt2;
  constexpr std::array<std::array<double, 2>, 8> kDirections{
      {{1, 0}, {kHalf, -kHalf}, {0, -1}, {-kHalf, -kHalf}, {-1, 0}, {-kHalf, kHalf}, {0, 1}, {kHalf, kHalf}}};
  for (int k = 0; k < n; ++k) {
    const auto& [x, z] = kDirections[static_cast<std::size_t>((first + k) % 8)];
    points.emplace_back(r * x, y, r * z);
  }
}

/// Points of a shape that is not a sphere, in its axes.
std::vector<Vec3> points_of(const Shape& shape) {
  std::vector<Vec3> points;
  if (shape.kind == Shape::Kind::box) {
    const std::array<Vec3, 8> corners = box_corners(shape.size);
    return {corners.begin(), corners.end()};
  }
  if (shape.kind == Shape::Kind::hull) return shape.hull->corners;
  const bool half = shape.kind == Shape::Kind::half_cylinder;
  // The arc of a half cylinder goes from +z over +x to -z, and ends at the straight edges.
  for (const double side : {-0.5, 0.5}) add_arc(shape.size.x(), side * shape.size.y(), half ? 6 : 0, half ? 5 : 8, points);
  return points;
}

/// True if the axes of cylinder and hinge are the same. `frame` is the pose of the hinge in the frame of the body.
bool on_axis(const Shape& cylinder, const Pose& frame, const Vec3& axis) {
  const Vec3 along = frame.R * axis;
  const Vec3 way = cylinder.in_body.p - frame.p;
  return along.cross(cylinder.in_body.R.col(1)).norm() <= kOnAxis &&
         (way - along * along.dot(way)).norm() <= kOnAxis * cylinder.size.x();
}

bool wheel(const ModuleType& type, std::size_t body, const Shape& shape) {
  if (shape.kind != Shape::Kind::cylinder) return false;
  const auto hinges = std::count_if(type.hinges.begin(), type.hinges.end(),
                                    [&](const HingeType& hinge) { return hinge.parent == body || hinge.child == body; });
  return std::any_of(type.hinges.begin(), type.hinges.end(), [&](const HingeType& hinge) {
    if (hinge.hi != kNoStop) return false;
    if (hinge.child == body) return on_axis(shape, {}, hinge.axis);
    return hinge.parent == body && hinges == 1 && on_axis(shape, hinge.in_parent, hinge.axis);
  });
}

/// An element and the number of its shape in the body.
struct Element {
  ContactType contact;
  std::size_t shape;
};

std::vector<Element> elements_of(const ModuleType& type, std::size_t body) {
  std::vector<Element> elements;
  const std::vector<Shape>& shapes = type.bodies[body].shapes;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const Shape& shape = shapes[s];
    if (shape.kind == Shape::Kind::sphere || wheel(type, body, shape)) {
      elements.push_back({{body, shape.in_body.p, shape.size.x()}, s});
      continue;
    }
    for (const Vec3& point : points_of(shape)) elements.push_back({{body, shape.in_body * point, 0}, s});
  }
  return elements;
}

/// True if a point or sphere lies in a sphere.
bool in_sphere(const ContactType& inner, const ContactType& outer, double rounding) {
  return (inner.centre - outer.centre).norm() <= outer.radius - inner.radius + rounding;
}

/// Adds the elements of one body that are neither inside another shape nor at the place of an earlier element.
void add_outer(const std::vector<Shape>& shapes, const std::vector<Element>& elements, std::vector<ContactType>& all) {
  const auto [low, high] = bounds(shapes);
  const double rounding = kOnePlace * (high - low).norm();
  const auto same = [&](const ContactType& a, const ContactType& b) {
    return a.radius == b.radius && (a.centre - b.centre).norm() <= rounding;
  };
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const ContactType& one = elements[i].contact;
    bool hidden = false;
    for (std::size_t k = 0; k < elements.size() && !hidden; ++k) {
      const ContactType& other = elements[k].contact;
      hidden = same(one, other) ? k < i : other.radius > 0 && k != i && in_sphere(one, other, rounding);
    }
    for (std::size_t s = 0; s < shapes.size() && !hidden; ++s) {
      const bool in_it = s != elements[i].shape && distance(shapes[s], one.centre) <= rounding - one.radius;
      // A vertex that two shapes share is needed once.
      hidden = in_it && std::none_of(elements.begin(), elements.end(),
                                     [&](const Element& other) { return other.shape == s && same(other.contact, one); });
    }
    if (!hidden) all.push_back(one);
  }
}

}  // namespace

std::vector<ContactType> shape_contacts(const ModuleType& type) {
  std::vector<ContactType> all;
  for (std::size_t b = 0; b < type.bodies.size(); ++b) {
    if (!type.bodies[b].shapes.empty()) add_outer(type.bodies[b].shapes, elements_of(type, b), all);
  }
  return all;
}

}  // namespace gaitlab
