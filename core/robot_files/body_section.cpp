#include "core/robot_files/body_section.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/model/solid.h"
#include "core/robot_files/key_reader.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

Mat3 inertia_matrix(const std::array<double, 6>& inertia) {
  const auto& [xx, yy, zz, xy, xz, yz] = inertia;
  return (Mat3() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

void read_shape(const Node& node, BodyType& body, Problems& problems) {
  KeyReader reader(node, kShapeMap, "shape", problems);
  Shape shape;
  shape.in_body = reader.frame();
  std::size_t kinds = 0;
  for (std::size_t k = 0; k < kShapeMap.one_of.size(); ++k) {  // in the order of Shape::Kind
    const char* kind = kShapeMap.one_of[k];
    if (!reader.has(kind)) continue;
    ++kinds;
    shape.kind = static_cast<Shape::Kind>(k);
    if (kShapeMap.at(kind).form == ModuleForm::number) {
      reader.number(kind, shape.size.x());
    } else {
      reader.vector(kind, span_of(shape.size));
    }
  }
  if (kinds != 1 && node.kind == Node::Kind::map) {
    problems.add(node.place, fmt::format("the shape has {} of box, cylinder, half_cylinder and sphere; expected one", kinds));
  }
  body.shapes.push_back(shape);
  reader.finish();
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

void read_body(const Node& node, const SourceLocation& place, BodyType& body, Problems& problems) {
  const std::size_t before = problems.size();
  KeyReader reader(node, kBodyMap, in_quotes(body.name), problems);
  std::array<double, 6> inertia = {};
  reader.number("mass", body.mass);
  reader.vector("com", span_of(body.com));
  reader.vector("inertia", inertia);
  body.inertia = inertia_matrix(inertia);
  if (const Node* shapes = reader.take("shape")) {
    if (shapes->kind != Node::Kind::list)
      problems.add(shapes->place, fmt::format("shape is {}; expected a list of maps", found(*shapes)));
    for (const Node& item : shapes->kind == Node::Kind::list ? shapes->items : std::vector<Node>())
      read_shape(item, body, problems);
  }
  reader.finish();
  if (problems.size() != before || !(body.mass > 0) || reader.has("inertia")) return;
  if (const std::string why = no_inertia(body); !why.empty()) {
    problems.add(place, why);
  } else {
    inertia_of_shapes(body, !reader.has("com"), place, problems);
  }
}

}  // namespace gaitlab
