// Reader of a module type's YAML, which checks keys and their types. module_check.cpp checks the values.
#include "core/robot_files/module_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/files/file_kind.h"
#include "core/model/docking.h"
#include "core/model/shape_contacts.h"
#include "core/robot_files/body_pair_list.h"
#include "core/robot_files/body_section.h"
#include "core/robot_files/module_check.h"
#include "core/settings/explainer.h"
#include "core/settings/reader.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// Converter of the keys of a module file to a module type. Bodies are referred to by name.
class ModuleReader {
 public:
  ModuleReader(const Node& document, Problems& problems) : document_(document), problems_(problems) {}

  ModuleType read(bool versioned) {
    if (!read_version(versioned)) return {};
    ModuleKeys keys;
    Reader reader(document_, "the module type", problems_, nullptr);
    keys.fields(reader);
    reader.finish();  // the keys within `actuator` and `controller` are read when the plugins of their types are known
    faulty_ = reader.faulty();
    check_name(document_.find("name"));
    type_.name = keys.name;
    type_.lattice = keys.lattice;
    type_.base = keys.base;
    type_.battery = keys.battery;
    each(document_, "bodies", keys.bodies, &ModuleReader::add_body);
    each(document_, "hinges", keys.hinges, &ModuleReader::add_hinge);
    each(document_, "faces", keys.faces, &ModuleReader::add_face);
    if (const Node* node = document_.find("contacts")) add_contacts(*node, keys.contacts);
    each(document_, "connectors", keys.connectors, &ModuleReader::add_connector);
    if (const Node* node = document_.find(kMayOverlap); node != nullptr && !names_.empty())
      type_.may_overlap = read_body_pairs(*node, names_, type_.name, problems_);
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
  /// Reads the format version. False, with a problem, for another version, whose keys would have other meanings.
  bool read_version(bool versioned) {
    if (document_.kind != Node::Kind::map) return true;
    Reader reader(document_, "", problems_, nullptr);
    if (versioned && !reader.has("gaitlab_module"))
      problems_.add(document_.place, "missing key 'gaitlab_module'; write gaitlab_module: 1");
    return reader.version("gaitlab_module");
  }

  /// Adds every element of a list or map that was read.
  template <class Keys>
  void each(const Node& map, const char* key, std::vector<Keys>& read, void (ModuleReader::*add)(const Node&, Keys&)) {
    const Node* const node = map.find(key);
    for (std::size_t i = 0; i < read.size(); ++i) {
      if (node->kind == Node::Kind::map) check_name(node->keys[i].first, node->keys[i].second);
      (this->*add)(node->items[i], read[i]);
    }
  }

  void check_name(const std::string& name, const SourceLocation& place) {
    if (!is_name(name, "_-"))
      problems_.add(place, "name " + in_quotes(name) + " is not allowed; expected letters, digits, `_` and `-`");
  }
  void check_name(const Node* node) {
    if (node != nullptr && node->kind == Node::Kind::scalar) check_name(node->text, node->place);
  }

  void add_body(const Node& node, BodyKeys& keys) {
    const SourceLocation& place = document_.find("bodies")->keys[names_.size()].second;
    const bool read = std::ranges::find(faulty_, &node) == faulty_.end();
    bodies_are_sound_ = complete_body(node, place, read, keys, problems_) && bodies_are_sound_;
    names_.push_back(keys.name);
    places_.bodies.push_back(place);
    type_.bodies.emplace_back(keys);
  }

  /// Index of the body with this name, which is the value of a key of `map`. Adds a problem for an unknown body.
  std::size_t body_of(const Node& map, const char* key, const std::string& name) {
    const Node* const node = map.find(key);
    const auto it = std::find(names_.begin(), names_.end(), name);
    if (node != nullptr && node->kind == Node::Kind::scalar && it == names_.end())
      problems_.add(node->place, "no body " + in_quotes(name) + offer(name, names_, "bodies"));
    return it == names_.end() ? 0 : static_cast<std::size_t>(it - names_.begin());
  }

  void add_hinge(const Node& node, HingeKeys& keys) {
    const Node* const name = node.find("name");
    check_name(name);
    if (keys.name == "dock") problems_.add(name->place, "a hinge cannot be named dock: that is where the module is docked");
    keys.parent = body_of(node, "parent", keys.of_parent);
    keys.child = body_of(node, "child", keys.of_child);
    keys.in_parent = {rpy(keys.turn), keys.origin};
    keys.lo = keys.free ? -kNoStop : keys.range[0];
    keys.hi = keys.free ? kNoStop : keys.range[1];
    keys.play.encoder_at_motor = keys.encoder == HingeKeys::Encoder::motor;
    check_drive(node, keys);
    check_play(node, keys);
    if (keys.drive == HingeKeys::Drive::none) keys.passive = keys.spring;
    type_.hinges.emplace_back(keys);
    places_.hinges.push_back(node);
  }

  /// Checks that a hinge has only the keys of a motor, or only those of spring and damper. The keys within `actuator` and
  /// `controller` are read later, when the plugins of their types are known.
  void check_drive(const Node& node, const HingeKeys& keys) {
    for (const char* key : {"actuator", "controller"}) {
      const Node* own = node.find(key);
      if (own == nullptr) continue;
      if (own->kind != Node::Kind::map) {
        problems_.add(own->place, fmt::format("{} is {}; expected a map", key, found(*own)));
      } else if (keys.drive == HingeKeys::Drive::none) {
        problems_.add(own->place, fmt::format("hinge '{}' has {} and drive: none; expected one of them", keys.name, key));
      }
    }
    if (keys.drive == HingeKeys::Drive::none) return;
    Explainer springs;
    SpringKeys().fields(springs);
    for (const std::string& key : springs.keys()) {
      const Node* own = node.find(key);
      if (own == nullptr) continue;
      problems_.add(own->place, fmt::format("{0} is only for a hinge without a motor, and this hinge has one; add drive: none, "
                                            "or remove {0}",
                                            key));
    }
  }

  /// Checks that only a gear with play has the keys of play.
  void check_play(const Node& node, const HingeKeys& keys) {
    const bool motor = keys.drive == HingeKeys::Drive::motor;
    for (const char* key : {"play", "play_stiffness", "encoder"}) {
      const Node* const own = node.find(key);
      if (own == nullptr) continue;
      if (!motor) {
        problems_.add(own->place, fmt::format("hinge '{}' has {} and drive: none; expected one of them, because play is that "
                                              "of a motor's gear",
                                              keys.name, key));
      } else if (node.find("play") == nullptr) {
        problems_.add(own->place,
                      fmt::format("hinge '{}' has {}, but no play; add play, in rad, or remove {}", keys.name, key, key));
      }
    }
  }

  void add_face(const Node& node, FaceKeys& keys) {
    keys.id = static_cast<int>(keys.number);
    keys.body = body_of(node, "body", keys.of_body);
    check_name(node.find("connector"));
    if (const Node* list = node.find("turns"); list != nullptr && list->kind == Node::Kind::list) read_turns(*list, keys);
    type_.faces.emplace_back(keys);
    places_.faces.push_back(node);
  }

  void read_turns(const Node& list, FaceKeys& face) {
    face.turns = {};
    for (const double turn : face.quarters) {
      const auto number = static_cast<std::size_t>(turn);
      if (turn != static_cast<double>(number)) {
        problems_.add(list.place, fmt::format("turns has {}; expected some of 0, 1, 2, 3 (times pi/2)", number_text(turn)));
        return;
      }
      face.turns[number] = true;
    }
    if (face.quarters.empty()) problems_.add(list.place, "turns is empty; expected some of 0, 1, 2, 3 (times pi/2)");
  }

  void add_contacts(const Node& node, ContactsKeys& keys) {
    each(node, "feet", keys.feet, &ModuleReader::add_contact<&ModuleType::feet>);
    each(node, "all", keys.all, &ModuleReader::add_contact<&ModuleType::all>);
    const auto shaped = [](const BodyType& body) { return !body.shapes.empty(); };
    const bool without = bodies_are_sound_ && std::none_of(type_.bodies.begin(), type_.bodies.end(), shaped);
    for (const auto& [key, of_shapes] : {std::pair("feet", keys.feet_of_shapes), std::pair("all", keys.all_of_shapes)}) {
      if (!without || !of_shapes) continue;
      const SourceLocation& place = node.find(key)->place;
      problems_.add(place, fmt::format("{} is `shapes`, but no body has a shape; expected a list of maps", key));
    }
    feet_of_shapes_ = keys.feet_of_shapes;
    all_of_shapes_ = keys.all_of_shapes;
    feet_are_all_ = node.find("feet") == nullptr;
  }

  template <std::vector<ContactType> ModuleType::*elements>
  void add_contact(const Node& node, ContactKeys& keys) {
    keys.body = body_of(node, "body", keys.of_body);
    const bool point = node.find("point") != nullptr;
    const bool sphere = node.find("sphere") != nullptr;
    if (sphere) keys.centre = keys.sphere;
    if (node.kind == Node::Kind::map && (point == sphere || (point && node.find("radius") != nullptr)))
      problems_.add(node.place, "expected {body, point: [x, y, z]} or {body, sphere: [x, y, z], radius: r}");
    (type_.*elements).emplace_back(keys);
  }

  void add_connector(const Node& /*node*/, ConnectorKeys& keys) { type_.connectors[keys.name] = static_cast<Connector&>(keys); }

  const Node& document_;
  Problems& problems_;
  ModuleType type_;
  ModulePlaces places_;
  std::vector<std::string> names_;
  std::vector<const Node*> faulty_;  ///< elements of lists and maps whose keys have a fault
  bool bodies_are_sound_ = true;     ///< false if a body has a fault, such as a missing shape
  bool feet_of_shapes_ = false, all_of_shapes_ = false, feet_are_all_ = false;
};

}  // namespace

ModuleType read_module(const Node& document, bool versioned, Problems& problems) {
  const std::size_t before = problems.size();
  ModuleReader reader(document, problems);
  ModuleType type = reader.read(versioned);
  problems.order(before);
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
