#include "core/robot_files/body_section.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/model/solid.h"
#include "core/robot_files/frame_fields.h"
#include "core/settings/reader.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

struct BodyFields {
  double mass = 0;
  Vec3 com = Vec3::Zero();
  std::array<double, 6> inertia = {};

  void fields(Fields& f) {
    f.number("mass", mass, {"kg", 0, kAnyNumber, "Mass; 0 only for a body between two hinges."});
    length(f, "com", com, "Centre of mass, body frame.");
    f.vector("inertia", inertia, {"kg m^2", -kAnyNumber, kAnyNumber, "xx, yy, zz, xy, xz, yz about the COM, body axes."});
  }
  [[nodiscard]] Mat3 matrix() const {
    const auto& [xx, yy, zz, xy, xz, yz] = inertia;
    return (Mat3() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
  }
};

void read_shape(const Node& node, BodyType& body, Problems& problems) {
  Reader reader(node, "shape", problems, nullptr);
  std::string source;
  reader.text("source", source, "Origin of the values.");
  FrameFields frame;
  frame.fields(reader);
  Shape shape;
  const Spec size{"m", kPositive, kAnyNumber, "Size."};
  const std::size_t kinds = static_cast<std::size_t>(reader.has("box")) + static_cast<std::size_t>(reader.has("cylinder")) +
                            static_cast<std::size_t>(reader.has("half_cylinder")) +
                            static_cast<std::size_t>(reader.has("sphere"));
  if (reader.has("cylinder")) shape.kind = Shape::Kind::cylinder;
  if (reader.has("half_cylinder")) shape.kind = Shape::Kind::half_cylinder;
  if (reader.has("sphere")) shape.kind = Shape::Kind::sphere;
  reader.vector("box", span_of(shape.size), size);
  reader.vector("cylinder", span_of(shape.size).first(2), size);
  reader.vector("half_cylinder", span_of(shape.size).first(2), size);
  reader.number("sphere", shape.size.x(), size);
  if (kinds != 1 && node.kind == Node::Kind::map) {
    problems.add(node.place, fmt::format("the shape has {} of box, cylinder, half_cylinder and sphere; expected one", kinds));
  }
  shape.in_body = frame.pose();
  body.shapes.push_back(shape);
  reader.finish();
}

/// Reason why the inertia of a body with mass cannot follow from its shapes; empty if it can.
std::string no_inertia(const BodyType& body, std::int64_t format) {
  const std::string name = in_quotes(body.name);
  if (format < kFormatOfShapes) {
    return fmt::format(
        "body {} has no inertia; expected inertia: [xx, yy, zz, xy, xz, yz], or gaitlab_module: {}, in which it "
        "follows from shape",
        name, kFormatOfShapes);
  }
  if (body.shapes.empty())
    return fmt::format("body {} has neither inertia nor shape; expected inertia, or shape, from which it follows", name);
  if (body.shapes.size() <= kMostShapes) return "";
  return fmt::format("body {} has {} shapes and no inertia; inertia follows from at most {} shapes", name, body.shapes.size(),
                     kMostShapes);
}

void inertia_of_shapes(BodyType& body, bool with_com, const SourceLocation& place, Problems& problems) {
  const Solid whole = united(body.shapes);
  body.inertia = whole.inertia(body.mass);
  if (with_com) body.com = whole.centre;
  if (!body.inertia.allFinite() || !body.com.allFinite()) {
    problems.add(place, fmt::format("the shapes of body {} are too small or too large for an inertia; expected sizes in m",
                                    in_quotes(body.name)));
  }
}

}  // namespace

void read_body(const Node& node, const SourceLocation& place, std::int64_t format, BodyType& body, Problems& problems) {
  const std::size_t before = problems.size();
  BodyFields values;
  Reader reader(node, in_quotes(body.name), problems, nullptr);
  std::string source;
  reader.text("source", source, "Origin of the values.");
  values.fields(reader);
  body.mass = values.mass;
  body.com = values.com;
  body.inertia = values.matrix();
  if (const Node* shapes = reader.take("shape")) {
    if (shapes->kind != Node::Kind::list)
      problems.add(shapes->place, fmt::format("shape is {}; expected a list of maps", found(*shapes)));
    for (const Node& item : shapes->kind == Node::Kind::list ? shapes->items : std::vector<Node>())
      read_shape(item, body, problems);
  }
  reader.finish();
  if (problems.size() != before || format == 0 || !(body.mass > 0) || reader.has("inertia")) return;
  if (const std::string why = no_inertia(body, format); !why.empty()) {
    problems.add(place, why);
  } else {
    inertia_of_shapes(body, !reader.has("com"), place, problems);
  }
}

}  // namespace gaitlab
