// From a module type's YAML to a ModuleType: keys and their types. Whether it makes sense is checked in module_check.cpp.
#include "core/scenario/module_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/scenario/module_check.h"
#include "core/scenario/reader.h"
#include "core/scenario/wording.h"

namespace gaitlab {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr std::array<const char*, 2> kGenders{"active", "passive"};

void length(Fields& f, const char* key, Vec3& value, const char* about) {
  f.vector(key, span_of(value), {"m", -kAny, kAny, about});
}

void direction(Fields& f, const char* key, Vec3& value, const char* about) {
  f.vector(key, span_of(value), {"", -kAny, kAny, about});
}

/// `origin` and `rpy` of a frame.
struct FrameFields {
  Vec3 origin = Vec3::Zero(), turn = Vec3::Zero();

  void fields(Fields& f) {
    length(f, "origin", origin, "Origin in the body's frame.");
    f.vector("rpy", span_of(turn), {"rad", -kAny, kAny, "Roll, pitch, yaw."});
  }
  [[nodiscard]] Pose pose() const { return {rpy(turn), origin}; }
};

struct BodyFields {
  double mass = 0;
  Vec3 com = Vec3::Zero();
  std::array<double, 6> inertia = {};

  void fields(Fields& f) {
    f.number("mass", mass, {"kg", 0, kAny, "Mass; 0 only for a body between two hinges."});
    length(f, "com", com, "Centre of mass, body frame.");
    f.vector("inertia", inertia, {"kg m^2", -kAny, kAny, "xx, yy, zz, xy, xz, yz about the COM, body axes."});
  }
  [[nodiscard]] Mat3 matrix() const {
    const auto& [xx, yy, zz, xy, xz, yz] = inertia;
    return (Mat3() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
  }
};

/// Reads a module type's parts one by one; bodies are referred to by name.
class ModuleReader {
 public:
  ModuleReader(const Node& document, Problems& problems) : document_(document), problems_(problems) {}

  ModuleType read(bool versioned) {
    Reader reader = open(document_, "the module type");
    reader.version("gaitlab_module");
    if (versioned) reader.require({"gaitlab_module"});
    reader.require({"name", "bodies"});
    reader.text("name", type_.name, "Name of the type.");
    if (const Node* name = reader.take("name")) check_name(type_.name, *name);
    reader.flag("lattice", type_.lattice, "Bodies with faces fill cells of a cubic lattice.");
    read_bodies(reader.take("bodies"));
    each(reader.take("hinges"), "hinges", [this](const Node& node) { read_hinge(node); });
    each(reader.take("faces"), "faces", [this](const Node& node) { read_face(node); });
    if (const Node* node = reader.take("contacts")) read_contacts(*node);
    reader.take("actuator");  // its keys are known once its type's plugin is
    reader.finish();
    return std::move(type_);
  }

  [[nodiscard]] const ModulePlaces& places() const { return places_; }

 private:
  /// Every map of a module type may say where its values come from.
  Reader open(const Node& node, const std::string& name) {
    Reader reader(node, name, problems_, nullptr);
    std::string source;
    reader.text("source", source, "Where the values come from.");
    return reader;
  }

  void check_name(const std::string& name, const Node& node) {
    if (node.kind == Node::Kind::scalar && !is_name(name, "_-")) {
      problems_.add(node.place, "name " + in_quotes(name) + " is not allowed; expected letters, digits, _ and -");
    }
  }

  template <class Read>
  void each(const Node* list, const char* key, Read read) {
    if (list == nullptr) return;
    if (list->kind != Node::Kind::list) {
      problems_.add(list->place, fmt::format("{} is {}; expected a list of maps", key, found(*list)));
      return;
    }
    for (const Node& item : list->items) read(item);
  }

  void read_bodies(const Node* bodies) {
    if (bodies == nullptr) return;
    if (bodies->kind != Node::Kind::map || bodies->items.empty()) {
      const std::string what = bodies->kind == Node::Kind::map ? "an empty map" : found(*bodies);
      problems_.add(bodies->place, fmt::format("bodies is {}; expected a map with at least one NAME: {{mass: ...}}", what));
      return;
    }
    for (std::size_t i = 0; i < bodies->items.size(); ++i) {
      const auto& [name, place] = bodies->keys[i];
      Node key{Node::Kind::scalar, place};
      check_name(name, key);
      names_.push_back(name);
      places_.bodies.push_back(place);
      type_.bodies.push_back({name});
      read_body(bodies->items[i], type_.bodies.back());
    }
  }

  void read_body(const Node& node, BodyType& body) {
    BodyFields values;
    Reader reader = open(node, in_quotes(body.name));
    values.fields(reader);
    body.mass = values.mass;
    body.com = values.com;
    body.inertia = values.matrix();
    each(reader.take("shape"), "shape", [&](const Node& item) { read_shape(item, body); });
    reader.finish();
  }

  void read_shape(const Node& node, BodyType& body) {
    Reader reader = open(node, "shape");
    FrameFields frame;
    frame.fields(reader);
    Shape shape;
    const Spec size{"m", kPositive, kAny, "Size."};
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
      problems_.add(node.place,
                    fmt::format("the shape has {} of box, cylinder, half_cylinder and sphere; expected one", kinds));
    }
    shape.in_body = frame.pose();
    body.shapes.push_back(shape);
    reader.finish();
  }

  /// Index of the body that `key` names; a problem where there is none.
  std::size_t body_of(Reader& reader, const char* key) {
    reader.require({key});
    std::string name;
    reader.text(key, name, "A body's name.");
    const Node* node = reader.take(key);
    const auto it = std::find(names_.begin(), names_.end(), name);
    if (node != nullptr && node->kind == Node::Kind::scalar && it == names_.end()) {
      problems_.add(node->place, "no body " + in_quotes(name) + offer(name, names_, "bodies"));
    }
    return it == names_.end() ? 0 : static_cast<std::size_t>(it - names_.begin());
  }

  void read_hinge(const Node& node) {
    Reader reader = open(node, "hinge");
    HingeType hinge;
    std::array<double, 2> range{};
    FrameFields frame;
    reader.require({"name", "axis", "range"});
    reader.text("name", hinge.name, "Name of the hinge and of its joint.");
    if (const Node* name = reader.take("name")) {
      check_name(hinge.name, *name);
      if (hinge.name == "dock") problems_.add(name->place, "a hinge cannot be named dock: that is where the module is docked");
    }
    hinge.parent = body_of(reader, "parent");
    hinge.child = body_of(reader, "child");
    frame.fields(reader);
    direction(reader, "axis", hinge.axis, "Axis, hinge frame.");
    reader.vector("range", range, {"rad", -kAny, kAny, "Smallest and largest angle."});
    hinge.in_parent = frame.pose();
    hinge.lo = range[0];
    hinge.hi = range[1];
    type_.hinges.push_back(hinge);
    places_.hinges.push_back(node);
    reader.finish();
  }

  void read_face(const Node& node) {
    Reader reader = open(node, "face");
    FaceType face;
    std::int64_t id = 0;
    reader.require({"id", "gender", "origin", "normal", "reference"});
    reader.integer("id", id, {"", 0, 1000, "Number of the face in build files."});
    face.body = body_of(reader, "body");
    reader.choice("gender", face.gender, kGenders, "An active face docks on a passive one.");
    length(reader, "origin", face.origin, "Middle of the face, body frame.");
    direction(reader, "normal", face.normal, "Outward normal, body frame.");
    direction(reader, "reference", face.reference, "In-plane reference direction, body frame.");
    face.id = static_cast<int>(id);
    type_.faces.push_back(face);
    places_.faces.push_back(node);
    reader.finish();
  }

  void read_contacts(const Node& node) {
    Reader reader = open(node, "contacts");
    each(reader.take("feet"), "feet", [this](const Node& item) { type_.feet.push_back(read_contact(item)); });
    each(reader.take("all"), "all", [this](const Node& item) { type_.all.push_back(read_contact(item)); });
    reader.finish();
  }

  ContactType read_contact(const Node& node) {
    Reader reader = open(node, "contact");
    ContactType contact;
    contact.body = body_of(reader, "body");
    const bool point = reader.has("point");
    const bool sphere = reader.has("sphere");
    length(reader, "point", contact.centre, "A point, body frame.");
    length(reader, "sphere", contact.centre, "Centre of a sphere, body frame.");
    reader.number("radius", contact.radius, {"m", kPositive, kAny, "Radius of the sphere."});
    if (sphere) reader.require({"radius"});
    if (node.kind == Node::Kind::map && (point == sphere || (point && reader.has("radius")))) {
      problems_.add(node.place, "expected {body, point: [x, y, z]} or {body, sphere: [x, y, z], radius: r}");
    }
    reader.finish();
    return contact;
  }

  const Node& document_;
  Problems& problems_;
  ModuleType type_;
  ModulePlaces places_;
  std::vector<std::string> names_;
};

}  // namespace

ModuleType read_module(const Node& document, bool versioned, Problems& problems) {
  const std::size_t before = problems.size();
  ModuleReader reader(document, problems);
  ModuleType type = reader.read(versioned);
  // Whether the parts fit together is a question only for parts that are there.
  if (problems.size() == before) check_module(type, reader.places(), problems);
  return type;
}

ModuleFile read_module_file(const std::string& path) {
  ModuleFile file;
  file.document = read_yaml(path);
  Problems problems;
  file.type = read_module(file.document, true, problems);
  problems.raise();
  return file;
}

}  // namespace gaitlab
