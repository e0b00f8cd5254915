#include "core/robot_files/body_section.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/model/hull_shape.h"
#include "core/model/solid.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

Mat3 inertia_matrix(const std::array<double, 6>& inertia) {
  const auto& [xx, yy, zz, xy, xz, yz] = inertia;
  return (Mat3() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

/// Makes the shape a hull of its points. Returns false, with a problem, if they have none.
bool set_hull(const Node& node, ShapeKeys& shape, Problems& problems) {
  const auto refuse = [&](const std::string& what) {
    problems.add(node.place, what + "; expected 4 to 64 points [x, y, z] that are not all in one plane");
    return false;
  };
  std::vector<Vec3> points;
  for (const std::vector<double>& row : shape.corners) {
    if (row.size() != 3) return refuse(fmt::format("a point of the hull has {}", counted(row.size(), "number")));
    points.emplace_back(row[0], row[1], row[2]);
  }
  if (points.size() > kMostHullPoints) return refuse(fmt::format("the hull has {} points", points.size()));
  std::optional<Shape> made = hull_shape(shape.in_body, points);
  if (!made) return refuse("all points of the hull are in one plane");
  static_cast<Shape&>(shape) = std::move(*made);
  return true;
}

/// Adds a shape to the body.
void add_shape(const Node& node, ShapeKeys shape, BodyType& body, Problems& problems) {
  std::size_t kinds = 0;
  for (const auto& [kind, name] : enum_table<Shape::Kind>()) {
    if (node.find(name) == nullptr) continue;
    ++kinds;
    shape.kind = kind;
  }
  if (kinds != 1 && node.kind == Node::Kind::map) {
    problems.add(node.place, fmt::format("the shape has {} of box, cylinder, half_cylinder, sphere and hull; expected exactly "
                                         "one of them",
                                         kinds));
  }
  shape.in_body = {rpy(shape.turn), shape.origin};
  if (shape.kind == Shape::Kind::hull && !set_hull(*node.find(name_of(shape.kind)), shape, problems)) return;
  body.shapes.emplace_back(shape);
}

/// Reason why the inertia of a body with mass cannot follow from its shapes; empty if it can.
std::string no_inertia(const BodyType& body) {
  const std::string name = in_quotes(body.name);
  if (body.shapes.empty())
    return fmt::format("body {} has neither inertia nor shape; expected inertia, or shape, from which it follows", name);
  if (body.shapes.size() <= kMostShapes) return "";
  return fmt::format("body {} has {} shapes and no inertia; inertia follows from at most {} shapes", name, body.shapes.size(),
                     kMostShapes);
}

void inertia_of_shapes(BodyType& body, bool with_com, const SourceLocation& place, Problems& problems) {
  const Solid whole = united(body.shapes);
  body.inertia = whole.inertia(body.mass);
  body.volume = whole.volume;
  if (with_com) body.com = whole.centre;
  if (!body.inertia.allFinite() || !body.com.allFinite()) {
    problems.add(place, fmt::format("the shapes of body {} are too small or too large for an inertia; expected sizes in m",
                                    in_quotes(body.name)));
  }
}

}  // namespace

bool complete_body(const Node& node, const SourceLocation& place, bool read, BodyKeys& body, Problems& problems) {
  const std::size_t before = problems.size();
  body.bare = body.outline.empty() && node.find("shape") != nullptr;
  for (std::size_t i = 0; i < body.outline.size(); ++i)
    add_shape(node.find("shape")->items[i], body.outline[i], body, problems);
  body.inertia = inertia_matrix(body.tensor);
  const bool sound = read && problems.size() == before;
  if (!sound || !(body.mass > 0) || node.find("inertia") != nullptr) return sound;
  if (const std::string why = no_inertia(body); !why.empty()) {
    problems.add(place, why);
  } else {
    inertia_of_shapes(body, node.find("com") == nullptr, place, problems);
  }
  return problems.size() == before;
}

}  // namespace gaitlab
