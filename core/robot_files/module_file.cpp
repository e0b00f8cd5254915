// Reader of a module type's YAML, which checks keys and their types. module_check.cpp checks the values.
#include "core/robot_files/module_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/model/docking.h"
#include "core/model/shape_contacts.h"
#include "core/robot_files/body_section.h"
#include "core/robot_files/frame_fields.h"
#include "core/robot_files/module_check.h"
#include "core/settings/reader.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

constexpr std::int64_t kNewest = 3;  ///< newest format version

/// Reader of a module type's parts one after the other. Bodies are referred to by name.
class ModuleReader {
 public:
  ModuleReader(const Node& document, Problems& problems) : document_(document), problems_(problems) {}

  ModuleType read(bool versioned) {
    Reader reader = open(document_, "the module type");
    places_.format = reader.version("gaitlab_module", kNewest);
    if (versioned) reader.require({"gaitlab_module"});
    if (versioned && !reader.has("gaitlab_module")) places_.format = kNewest;  // one problem, and not one for every newer key
    reader.require({"name", "bodies"});
    reader.text("name", type_.name, "Name of the type.");
    if (const Node* name = reader.take("name")) check_name(type_.name, *name);
    reader.flag("lattice", type_.lattice, "Bodies with faces fill cells of a cubic lattice.");
    read_bodies(reader.take("bodies"));
    each(reader.take("hinges"), "hinges", [this](const Node& node) { read_hinge(node); });
    each(reader.take("faces"), "faces", [this](const Node& node) { read_face(node); });
    if (const Node* node = reader.take("contacts")) read_contacts(*node);
    reader.take("actuator");  // the keys within `actuator` are read when the plugin of its type is known
    if (newer(reader, document_, {"connectors", "controller"})) read_connectors(reader.take("connectors"));
    reader.finish();
    return std::move(type_);
  }

  [[nodiscard]] const ModulePlaces& places() const { return places_; }

  /// Adds the contact elements that follow from other parts of the type, which has been checked.
  void complete(ModuleType& type) const {
    if (all_of_shapes_) type.all = shape_contacts(type);
    if (feet_of_shapes_) type.feet = shape_contacts(type);
    if (feet_are_all_) type.feet = type.all;
  }

 private:
  /// Opens a map of a module type. The map may have a `source`.
  Reader open(const Node& node, const std::string& name) {
    Reader reader(node, name, problems_, nullptr);
    std::string source;
    reader.text("source", source, "Origin of the values.");
    return reader;
  }

  /// True if the keys of format 2 may be read. In a text of format 1, each of these keys is a problem.
  bool newer(Reader& reader, const Node& map, std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
      const Node* value = reader.take(key);
      if (value != nullptr && places_.format < 2) need_format(2, in_quotes(key) + " is a key", value->place);
    }
    return places_.format >= 2 && map.kind == Node::Kind::map;
  }

  void need_format(std::int64_t format, const std::string& what, const SourceLocation& place) {
    if (places_.format == 0) return;  // the version is invalid and has been reported
    problems_.add(place, fmt::format("{} of module format {}, but this file has format {}; write gaitlab_module: {}", what,
                                     format, places_.format, format));
  }

  void read_connectors(const Node* connectors) {
    if (connectors == nullptr) return;
    if (connectors->kind != Node::Kind::map) {
      problems_.add(connectors->place,
                    fmt::format("connectors is {}; expected a map NAME: {{tension: ..., shear: ...}}", found(*connectors)));
      return;
    }
    for (std::size_t i = 0; i < connectors->items.size(); ++i) {
      const auto& [name, place] = connectors->keys[i];
      check_name(name, Node{Node::Kind::scalar, place});
      Reader reader(connectors->items[i], in_quotes(name), problems_, nullptr);
      Connector limits;
      reader.number("tension", limits.tension, {"N", kPositive, kAnyNumber, "Largest pull along the normal."});
      reader.number("shear", limits.shear, {"N", kPositive, kAnyNumber, "Largest force in the plane of the face."});
      reader.number("bending", limits.bending, {"N m", kPositive, kAnyNumber, "Largest moment about axes in that plane."});
      reader.number("torsion", limits.torsion, {"N m", kPositive, kAnyNumber, "Largest moment about the normal."});
      reader.text("source", limits.source, "Origin of the values.");
      reader.finish();
      type_.connectors[name] = limits;
    }
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
      read_body(bodies->items[i], place, places_.format, type_.bodies.back(), problems_);
    }
  }

  /// Index of the body that `key` names. Adds a problem for an unknown body.
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
    read_range(reader, hinge);
    hinge.in_parent = frame.pose();
    if (newer(reader, node,
              {"drive", "stiffness", "rest", "damping", "friction", "friction_speed", "actuator", "controller"})) {
      read_drive(reader, hinge);
    }
    type_.hinges.push_back(hinge);
    places_.hinges.push_back(node);
    reader.finish();
  }

  void read_range(Reader& reader, HingeType& hinge) {
    const Node* node = reader.take("range");
    if (node != nullptr && node->kind == Node::Kind::scalar && node->text == "free") {
      if (places_.format < 2) need_format(2, "range: free is", node->place);
      hinge.lo = -kNoStop;
      hinge.hi = kNoStop;
      return;
    }
    if (node != nullptr && node->kind != Node::Kind::list && places_.format >= 2) {
      problems_.add(node->place, fmt::format("range is {}; expected a list of 2 numbers in rad, or free", found(*node)));
      return;
    }
    std::array<double, 2> range{};
    reader.vector("range", range, {"rad", -kAnyNumber, kAnyNumber, "Smallest and largest angle."});
    hinge.lo = range[0];
    hinge.hi = range[1];
  }

  /// Reads the motor of a hinge, or spring and damper of a hinge without a motor. The keys of `actuator` and `controller` are
  /// read later, when the plugins of their types are known.
  void read_drive(Reader& reader, HingeType& hinge) {
    enum class Drive { motor, none };
    constexpr std::array<const char*, 2> kDrives{"motor", "none"};
    Drive drive = Drive::motor;
    reader.choice("drive", drive, kDrives, "motor, or none for a passive hinge.");
    for (const char* key : {"actuator", "controller"}) {
      const Node* own = reader.take(key);
      if (own == nullptr) continue;
      if (own->kind != Node::Kind::map) {
        problems_.add(own->place, fmt::format("{} is {}; expected a map", key, found(*own)));
      } else if (drive == Drive::none) {
        problems_.add(own->place, fmt::format("hinge '{}' has {} and drive: none; expected one of them", hinge.name, key));
      }
    }
    Passive passive;
    reader.number("stiffness", passive.stiffness, {"N m/rad", 0, 1e6, "Stiffness of a spring."});
    reader.number("rest", passive.rest, {"rad", -1000, 1000, "Angle at which the spring has no torque."});
    reader.number("damping", passive.damping, {"N m s/rad", 0, 1e6, "Coefficient of a viscous damper."});
    reader.number("friction", passive.friction, {"N m", 0, 1e6, "Dry friction."});
    reader.number("friction_speed", passive.friction_speed, {"rad/s", 1e-6, 1e3, "Speed below which dry friction is viscous."});
    if (drive == Drive::none) {
      hinge.passive = passive;
      return;
    }
    for (const char* key : {"stiffness", "rest", "damping", "friction", "friction_speed"}) {
      if (const Node* own = reader.take(key)) {
        problems_.add(
            own->place,
            fmt::format("{0} is only for a hinge without a motor, and this hinge has one; add drive: none, or remove {0}",
                        key));
      }
    }
  }

  void read_face(const Node& node) {
    Reader reader = open(node, "face");
    FaceType face;
    std::int64_t id = 0;
    reader.require({"id", "gender", "origin", "normal", "reference"});
    reader.integer("id", id, {"", 0, 1000, "Number of the face in build files."});
    face.body = body_of(reader, "body");
    const Node* gender = reader.take("gender");
    if (places_.format < 2 && gender != nullptr && gender->text == "none") {
      need_format(2, "gender: none is", gender->place);
    } else {
      reader.choice("gender", face.gender, enum_names<Gender>().first(places_.format < 2 ? 2 : 3),
                    "An active face docks on a passive one, none on none.");
    }
    if (newer(reader, node, {"connector", "turns"})) read_docking(reader, face);
    length(reader, "origin", face.origin, "Middle of the face, body frame.");
    direction(reader, "normal", face.normal, "Outward normal, body frame.");
    direction(reader, "reference", face.reference, "In-plane reference direction, body frame.");
    face.id = static_cast<int>(id);
    type_.faces.push_back(face);
    places_.faces.push_back(node);
    reader.finish();
  }

  void read_docking(Reader& reader, FaceType& face) {
    reader.text("connector", face.connector, "Name of the connector; only faces with the same connector dock.");
    if (const Node* name = reader.take("connector")) check_name(face.connector, *name);
    std::vector<double> turns{0, 1, 2, 3};
    reader.numbers("turns", turns, {"", 0, 3, "Orientations in which the face docks."});
    const Node* list = reader.take("turns");
    if (list == nullptr || list->kind != Node::Kind::list) return;
    face.turns = {};
    for (const double turn : turns) {
      const auto number = static_cast<std::size_t>(turn);
      if (turn != static_cast<double>(number)) {
        problems_.add(list->place, fmt::format("turns has {}; expected some of 0, 1, 2, 3 (times pi/2)", number_text(turn)));
        return;
      }
      face.turns[number] = true;
    }
    if (turns.empty()) problems_.add(list->place, "turns is empty; expected some of 0, 1, 2, 3 (times pi/2)");
  }

  void read_contacts(const Node& node) {
    Reader reader = open(node, "contacts");
    read_elements(reader.take("feet"), "feet", type_.feet, feet_of_shapes_);
    read_elements(reader.take("all"), "all", type_.all, all_of_shapes_);
    feet_are_all_ = places_.format >= kFormatOfShapes && !reader.has("feet");
    reader.finish();
  }

  /// Reads a list of contact elements, or the word `shapes`.
  void read_elements(const Node* node, const char* key, std::vector<ContactType>& elements, bool& of_shapes) {
    of_shapes = node != nullptr && node->kind == Node::Kind::scalar && node->text == "shapes";
    if (!of_shapes) {
      if (node != nullptr && node->kind != Node::Kind::list) {
        problems_.add(node->place, fmt::format("{} is {}; expected a list of maps, or shapes", key, found(*node)));
        return;
      }
      each(node, key, [&](const Node& item) { elements.push_back(read_contact(item)); });
      return;
    }
    const auto shaped = [](const BodyType& body) { return !body.shapes.empty(); };
    if (places_.format < kFormatOfShapes) {
      need_format(kFormatOfShapes, fmt::format("{}: shapes is", key), node->place);
    } else if (std::none_of(type_.bodies.begin(), type_.bodies.end(), shaped)) {
      problems_.add(node->place, fmt::format("{} is shapes, but no body has a shape; expected a list of maps", key));
    }
  }

  ContactType read_contact(const Node& node) {
    Reader reader = open(node, "contact");
    ContactType contact;
    contact.body = body_of(reader, "body");
    const bool point = reader.has("point");
    const bool sphere = reader.has("sphere");
    length(reader, "point", contact.centre, "A point, body frame.");
    length(reader, "sphere", contact.centre, "Centre of a sphere, body frame.");
    reader.number("radius", contact.radius, {"m", kPositive, kAnyNumber, "Radius of the sphere."});
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
  bool feet_of_shapes_ = false, all_of_shapes_ = false, feet_are_all_ = false;
};

}  // namespace

ModuleType read_module(const Node& document, bool versioned, Problems& problems) {
  const std::size_t before = problems.size();
  ModuleReader reader(document, problems);
  ModuleType type = reader.read(versioned);
  // Parts are checked against each other only if all of them were read without problems.
  if (problems.size() == before) check_module(type, reader.places(), problems);
  if (problems.size() == before) reader.complete(type);
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
