// Reader of a module type's YAML, which checks keys and their types. module_check.cpp checks the values.
#include "core/robot_files/module_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/files/file_kind.h"
#include "core/model/docking.h"
#include "core/model/shape_contacts.h"
#include "core/robot_files/body_pair_list.h"
#include "core/robot_files/body_section.h"
#include "core/robot_files/key_reader.h"
#include "core/robot_files/module_check.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// Reader of a module type's parts one after the other. Bodies are referred to by name.
class ModuleReader {
 public:
  ModuleReader(const Node& document, Problems& problems) : document_(document), problems_(problems) {}

  ModuleType read(bool versioned) {
    if (!read_version(versioned)) return {};
    KeyReader reader = open(document_, kModuleMap, "the module type");
    reader.text("name", type_.name);
    if (const Node* name = reader.take("name")) check_name(type_.name, *name);
    reader.flag("lattice", type_.lattice);
    read_bodies(reader.take("bodies"));
    each(reader.take("hinges"), "hinges", [this](const Node& node) { read_hinge(node); });
    each(reader.take("faces"), "faces", [this](const Node& node) { read_face(node); });
    if (const Node* node = reader.take("contacts")) read_contacts(*node);
    read_connectors(reader.take("connectors"));
    if (const Node* node = reader.take(kMayOverlap); node != nullptr && !names_.empty())
      type_.may_overlap = read_body_pairs(*node, names_, type_.name, problems_);
    reader.finish();  // the keys within `actuator` and `controller` are read when the plugins of their types are known
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
  KeyReader open(const Node& node, const ModuleMap& map, const std::string& name) { return {node, map, name, problems_}; }

  /// Reads the format version. False, with a problem, for another version, whose keys would have other meanings.
  bool read_version(bool versioned) {
    if (document_.kind != Node::Kind::map) return true;
    Reader reader(document_, "", problems_, nullptr);
    if (versioned && !reader.has("gaitlab_module"))
      problems_.add(document_.place, "missing key 'gaitlab_module'; write gaitlab_module: 1");
    return reader.version("gaitlab_module");
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
      KeyReader reader = open(connectors->items[i], kConnectorMap, in_quotes(name));
      Connector limits;
      reader.number("tension", limits.tension);
      reader.number("shear", limits.shear);
      reader.number("bending", limits.bending);
      reader.number("torsion", limits.torsion);
      reader.text("source", limits.source);
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
    const std::size_t before = problems_.size();
    for (std::size_t i = 0; i < bodies->items.size(); ++i) {
      const auto& [name, place] = bodies->keys[i];
      Node key{Node::Kind::scalar, place};
      check_name(name, key);
      names_.push_back(name);
      places_.bodies.push_back(place);
      type_.bodies.push_back({name});
      read_body(bodies->items[i], place, type_.bodies.back(), problems_);
    }
    bodies_are_sound_ = problems_.size() == before;
  }

  /// Index of the body that `key` names. Adds a problem for an unknown body.
  std::size_t body_of(KeyReader& reader, const char* key) {
    std::string name;
    reader.text(key, name);
    const Node* node = reader.take(key);
    const auto it = std::find(names_.begin(), names_.end(), name);
    if (node != nullptr && node->kind == Node::Kind::scalar && it == names_.end()) {
      problems_.add(node->place, "no body " + in_quotes(name) + offer(name, names_, "bodies"));
    }
    return it == names_.end() ? 0 : static_cast<std::size_t>(it - names_.begin());
  }

  void read_hinge(const Node& node) {
    KeyReader reader = open(node, kHingeMap, "hinge");
    HingeType hinge;
    reader.text("name", hinge.name);
    if (const Node* name = reader.take("name")) {
      check_name(hinge.name, *name);
      if (hinge.name == "dock") problems_.add(name->place, "a hinge cannot be named dock: that is where the module is docked");
    }
    hinge.parent = body_of(reader, "parent");
    hinge.child = body_of(reader, "child");
    hinge.in_parent = reader.frame();
    reader.vector("axis", span_of(hinge.axis));
    read_range(reader, hinge);
    read_drive(reader, hinge);
    type_.hinges.push_back(hinge);
    places_.hinges.push_back(node);
    reader.finish();
  }

  void read_range(KeyReader& reader, HingeType& hinge) {
    if (reader.word("range", "free")) {
      hinge.lo = -kNoStop;
      hinge.hi = kNoStop;
      return;
    }
    const Node* node = reader.take("range");
    if (node != nullptr && node->kind != Node::Kind::list) {
      problems_.add(node->place, fmt::format("range is {}; expected a list of 2 numbers in rad, or free", found(*node)));
      return;
    }
    std::array<double, 2> range{};
    reader.vector("range", range);
    hinge.lo = range[0];
    hinge.hi = range[1];
  }

  /// Reads the motor of a hinge, or spring and damper of a hinge without a motor. The keys of `actuator` and `controller` are
  /// read later, when the plugins of their types are known.
  void read_drive(KeyReader& reader, HingeType& hinge) {
    enum class Drive { motor, none };
    Drive drive = Drive::motor;
    reader.choice("drive", drive);
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
    reader.number("stiffness", passive.stiffness);
    reader.number("rest", passive.rest);
    reader.number("damping", passive.damping);
    reader.number("friction", passive.friction);
    reader.number("friction_speed", passive.friction_speed);
    if (drive == Drive::none) {
      hinge.passive = passive;
      return;
    }
    for (const ModuleKey& key : kHingeMap.keys) {
      const Node* own = key.passive ? reader.take(key.key) : nullptr;
      if (own == nullptr) continue;
      problems_.add(own->place, fmt::format("{0} is only for a hinge without a motor, and this hinge has one; add drive: none, "
                                            "or remove {0}",
                                            key.key));
    }
  }

  void read_face(const Node& node) {
    KeyReader reader = open(node, kFaceMap, "face");
    FaceType face;
    std::int64_t id = 0;
    reader.integer("id", id);
    face.body = body_of(reader, "body");
    reader.choice("gender", face.gender);
    read_docking(reader, face);
    reader.vector("origin", span_of(face.origin));
    reader.vector("normal", span_of(face.normal));
    reader.vector("reference", span_of(face.reference));
    face.id = static_cast<int>(id);
    type_.faces.push_back(face);
    places_.faces.push_back(node);
    reader.finish();
  }

  void read_docking(KeyReader& reader, FaceType& face) {
    reader.text("connector", face.connector);
    if (const Node* name = reader.take("connector")) check_name(face.connector, *name);
    std::vector<double> turns{0, 1, 2, 3};
    reader.numbers("turns", turns);
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
    KeyReader reader = open(node, kContactsMap, "contacts");
    feet_of_shapes_ = read_elements(reader, "feet", type_.feet);
    all_of_shapes_ = read_elements(reader, "all", type_.all);
    feet_are_all_ = !reader.has("feet");
    reader.finish();
  }

  /// Reads a list of contact elements. Returns true for the word `shapes` instead.
  bool read_elements(KeyReader& reader, const char* key, std::vector<ContactType>& elements) {
    const Node* node = reader.take(key);
    if (node == nullptr) return false;
    if (!reader.word(key, "shapes")) {
      if (node->kind != Node::Kind::list) {
        problems_.add(node->place, fmt::format("{} is {}; expected a list of maps, or shapes", key, found(*node)));
        return false;
      }
      for (const Node& item : node->items) elements.push_back(read_contact(item));
      return false;
    }
    const auto shaped = [](const BodyType& body) { return !body.shapes.empty(); };
    if (bodies_are_sound_ && std::none_of(type_.bodies.begin(), type_.bodies.end(), shaped)) {
      problems_.add(node->place, fmt::format("{} is shapes, but no body has a shape; expected a list of maps", key));
    }
    return true;
  }

  ContactType read_contact(const Node& node) {
    KeyReader reader = open(node, kContactMap, "contact");
    ContactType contact;
    contact.body = body_of(reader, "body");
    const bool point = reader.has("point");
    const bool sphere = reader.has("sphere");
    reader.vector("point", span_of(contact.centre));
    reader.vector("sphere", span_of(contact.centre));
    reader.number("radius", contact.radius);
    if (sphere) reader.require("radius");
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
  bool bodies_are_sound_ = true;  ///< false if a body has a fault, such as a missing shape
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
  expect_kind(path, FileKind::module);
  file.document = read_yaml(path);
  Problems problems;
  file.type = read_module(file.document, true, problems);
  problems.raise();
  return file;
}

}  // namespace gaitlab
