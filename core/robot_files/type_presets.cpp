#include "core/robot_files/type_presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/plugin/plugin_instance.h"
#include "core/robot_files/servo_file.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab {
namespace {

constexpr const char* kByDefault = "chosen: ";
constexpr const char* kRest = "; the rest: ";

const Node* map_of(const Node& of, Kind kind) {
  const Node* map = of.find(word(kind));
  return map != nullptr && map->kind == Node::Kind::map ? map : nullptr;
}

std::string type_of(const Node* map, Kind kind) {
  const Node* type = map == nullptr ? nullptr : map->find("type");
  return type == nullptr ? describe(kind).default_type : type->text;
}

/// Keys of a map whose values are numbers of the motor.
std::vector<std::string> figures_of(const Node* map) {
  std::vector<std::string> keys;
  if (map == nullptr) return keys;
  for (const auto& [key, place] : map->keys) {
    if (key != "type" && key != "source" && key != kIdentified) keys.push_back(key);
  }
  return keys;
}

std::string source_of(const Node* map) {
  const Node* source = map == nullptr ? nullptr : map->find("source");
  return source == nullptr ? "" : source->text;
}

/// Collects every field of a plugin's settings, as values per joint or as text.
class Seen final : public Fields {
 public:
  struct Value {
    PerJoint each;
    std::string text;
  };
  void visit(const Field& field) override {
    if (const auto* each = std::get_if<field::EachJoint>(&field.value)) {
      values[field.key] = {each->value, {}};
      return;
    }
    const std::vector<std::string> no_names;
    Writer writer(no_names);
    writer.visit(field);
    values[field.key] = {{}, print_yaml(writer.take())};
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  std::map<std::string, Value> values;
};

/// Collects the default numbers of a plugin's fields.
class Figures final : public Fields {
 public:
  void visit(const Field& field) override {
    const auto* each = std::get_if<field::EachJoint>(&field.value);
    if (each == nullptr) return;
    const bool limit = each->role == field::Role::limit && each->usual == nullptr;
    const bool set = each->role == field::Role::setting && each->value.common != 0;
    if (limit || set) found.push_back({field.key, each->spec.unit, each->value.common});
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  std::vector<DefaultFigure> found;
};

/// Combines several settings that each apply to some joints. A field that all joints share must be equal in all settings.
class PerJointMerge final : public Fields {
 public:
  PerJointMerge(const std::vector<Seen>& kinds, const std::vector<std::size_t>& of_joint)
      : kinds_(kinds), of_joint_(of_joint) {}

  void visit(const Field& field) override {
    const auto* each = std::get_if<field::EachJoint>(&field.value);
    if (each == nullptr) {
      for (const Seen& kind : kinds_) {
        if (value(kind, field.key).text != value(kinds_.front(), field.key).text) differing.emplace_back(field.key);
      }
      return;
    }
    std::vector<double> values;
    for (std::size_t j = 0; j < of_joint_.size(); ++j) values.push_back(value(kinds_[of_joint_[j]], field.key).each[j]);
    if (std::ranges::all_of(values, [&](double one) { return one == values.front(); })) {
      each->value = PerJoint{values.front()};
    } else {
      each->value.each = std::move(values);
    }
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  std::vector<std::string> differing;  ///< keys of common fields that differ

 private:
  static const Seen::Value& value(const Seen& of, const char* key) {
    static const Seen::Value kNone;
    const auto at = of.values.find(key);
    return at == of.values.end() ? kNone : at->second;
  }
  const std::vector<Seen>& kinds_;
  const std::vector<std::size_t>& of_joint_;
};

}  // namespace

std::vector<DefaultFigure> default_figures(const Entry& entry) {
  Figures figures;
  visit_settings(entry, default_settings(entry).get(), figures);
  return figures.found;
}

std::string by_default(const std::vector<std::string>& keys, const Entry& entry) {
  return fmt::format("{}{} by default of {}", kByDefault, fmt::join(keys, ", "), entry.name);
}

std::string with_defaults(const std::vector<std::string>& keys, const Entry& entry, const std::string& source) {
  return by_default(keys, entry) + kRest + source;
}

std::string without_defaults(const std::string& source, const Entry& entry) {
  const std::string end = by_default({}, entry).substr(std::string_view(kByDefault).size()) + kRest;
  const std::size_t at = source.find(end);
  const bool listed = at != std::string::npos && source.starts_with(kByDefault) && source.find(';') == at + end.find(';');
  return listed ? source.substr(at + end.size()) : source;
}

std::vector<const Node*> preset_maps(const Node& document, Kind kind) {
  std::vector<const Node*> maps;
  const auto add = [&](const Node& of) {
    if (const Node* map = map_of(of, kind)) maps.push_back(map);
  };
  add(document);
  if (const Node* hinges = document.find("hinges")) std::ranges::for_each(hinges->items, add);
  return maps;
}

namespace {

const Node* type_node(const Node& of, Kind kind) {
  const Node* map = map_of(of, kind);
  return map == nullptr ? nullptr : map->find("type");
}

}  // namespace

bool known_types(const std::vector<Node>& documents, const Node& scenario, const Catalog& catalog, Problems& problems) {
  const std::size_t before = problems.size();
  for (const Kind kind : {Kind::actuator, Kind::controller}) {
    if (type_node(scenario, kind) != nullptr) continue;
    std::vector<std::string> known = catalog.names(kind);
    if (describe(kind).may_be_none) known.emplace_back("none");
    for (const Node& document : documents) {
      const Node* type = type_node(document, kind);
      if (type == nullptr || std::ranges::find(known, type->text) != known.end()) continue;
      problems.add(type->place, "type " + in_quotes(type->text) + " is unknown" + offer(type->text, known, "types"));
    }
  }
  return problems.size() == before;
}

TypePresets::TypePresets(Kind kind, const Robot* robot, const std::vector<Node>& documents)
    : kind_(kind), type_(describe(kind).default_type) {
  if (robot != nullptr) {
    choose(*robot, documents);
    return;
  }
  for (const Node& document : documents) {  // the first type decides which keys of the scenario are known
    const Node* map = map_of(document, kind);
    if (map == nullptr) continue;
    kinds_.push_back({map, nullptr});
    type_ = type_of(map, kind);
    return;
  }
}

void TypePresets::choose(const Robot& robot, const std::vector<Node>& documents) {
  std::vector<const Node*> maps;  // maps of the module types that have a hinge with a motor
  for (const Joint& joint : robot.joints) {
    const std::size_t type = robot.modules[joint.module].type;
    const std::vector<HingeType>& hinges = robot.types[type].hinges;
    const std::string name = joint.name.substr(joint.name.find('/') + 1);
    const auto number = static_cast<std::size_t>(std::ranges::find(hinges, name, &HingeType::name) - hinges.begin());
    const Maps of{map_of(documents[type], kind_), map_of(documents[type].find("hinges")->items[number], kind_)};
    if (joint.driven()) maps.push_back(of.of_type);
    // A hinge without a motor refers to arbitrary settings, because they are never used.
    const auto known = joint.driven() ? std::ranges::find(kinds_, of) : kinds_.begin();
    of_joint_.push_back(static_cast<std::size_t>(known - kinds_.begin()));
    if (joint.driven() && known == kinds_.end()) kinds_.push_back(of);
  }
  if (kinds_.empty()) of_joint_.clear();
  if (maps.empty()) return;
  type_ = type_of(maps.front(), kind_);
  const bool one_type = std::ranges::all_of(maps, [&](const Node* map) { return type_of(map, kind_) == type_; });
  const bool some_alone = kind_ == Kind::actuator && std::ranges::count(maps, nullptr) > 0 &&
                          std::ranges::any_of(maps, [](const Node* map) { return map != nullptr; });
  if (one_type && !some_alone) return;
  why_ = one_type ? "some of the module types with a motor state none"
                  : fmt::format("the module types have different {}s", word(kind_));
  for (const Node* map : maps) {
    if (map != nullptr && std::ranges::find(said_, map) == said_.end()) said_.push_back(map);
  }
}

bool TypePresets::holds(const Entry& entry) const {
  const auto says = [](const Maps& maps) { return maps.of_type != nullptr || maps.of_hinge != nullptr; };
  return agreed() && entry.name == type_ && std::ranges::any_of(kinds_, says);
}

std::vector<std::string> TypePresets::sources(const Entry& entry, const std::vector<std::string>& but,
                                              bool unidentified) const {
  std::vector<std::string> sources;
  const auto add = [&](const std::string& source) {
    if (std::ranges::find(sources, source) == sources.end()) sources.push_back(source);
  };
  const std::vector<DefaultFigure> defaults = default_figures(entry);
  for (const Maps& maps : kinds_) {
    if (unidentified && logs_of(maps) != nullptr) continue;
    std::vector<std::string> known = but;
    const auto takes = [&](const Node* map) {  // true if the map has numbers that are not in the list yet
      const std::size_t before = known.size();
      for (const std::string& key : figures_of(map)) {
        if (std::ranges::find(known, key) == known.end()) known.push_back(key);
      }
      return known.size() > before;
    };
    const bool of_hinge = takes(maps.of_hinge);
    if (takes(maps.of_type)) add(source_of(maps.of_type));
    const bool of_logs = maps.of_type != nullptr && maps.of_type->find(kIdentified) != nullptr;
    if (of_hinge) add(source_of(source_of(maps.of_hinge).empty() && !of_logs ? maps.of_type : maps.of_hinge));
    std::vector<std::string> assumed;
    for (const DefaultFigure& one : defaults) {
      if (one.value != 0 && std::ranges::find(known, one.key) == known.end()) assumed.push_back(one.key);
    }
    if (!assumed.empty()) add(by_default(assumed, entry));
  }
  return sources;
}

const Node* TypePresets::logs_of(const Maps& maps) {
  const auto logs = [](const Node* map) { return map == nullptr ? nullptr : map->find(kIdentified); };
  if (const Node* const of_hinge = logs(maps.of_hinge)) return of_hinge;
  const Node* const of_type = logs(maps.of_type);
  if (of_type == nullptr) return nullptr;
  const auto replaces = [&](const std::string& key) { return moves_joint(key, maps.of_type->find(key) != nullptr); };
  return std::ranges::any_of(figures_of(maps.of_hinge), replaces) ? nullptr : of_type;
}

Identification TypePresets::identification(std::size_t joint) const {
  Identification made;
  if (kinds_.empty()) return made;
  const Node* const stated = logs_of(kinds_[of_joint_.empty() ? 0 : of_joint_[joint]]);
  if (stated == nullptr) return made;
  Problems none;  // read() reports those of its values
  Reader reader(*stated, kIdentified, none, nullptr);
  made.fields(reader);
  return made;
}

void TypePresets::refuse(const SourceLocation& place, Problems& problems) const {
  Problem& problem = problems.add(place, fmt::format("{}; choose one: add {}: {{type: ...}}", why_, word(kind_)));
  for (const Node* map : said_) problem.notes.emplace_back(map->place, "one is here");
}

void TypePresets::read(const Entry& entry, const Maps& maps, void* settings, JointNames joints, Problems& of_type,
                       Problems& of_hinge) const {
  const auto apply = [&](const Node& map, Problems& problems, bool whole) {
    Reader preset(map, word(kind_), problems, joints);
    if (whole) preset.take("type");
    preset.take("source");
    Identification checked;
    preset.group(kIdentified, checked, "");
    if (const Node* const logs = map.find(kIdentified)) check_identified(*logs, checked, problems);
    visit_settings(entry, settings, preset);
    preset.finish();
  };
  if (maps.of_type != nullptr) apply(*maps.of_type, of_type, true);
  if (maps.of_hinge != nullptr) apply(*maps.of_hinge, of_hinge, false);
}

void TypePresets::fill(const Entry& entry, void* settings, JointNames joints, Problems& problems) const {
  if (!holds(entry)) return;
  read(entry, kinds_.front(), settings, joints, problems, problems);
  if (kinds_.size() == 1) return;
  std::vector<const Node*> told{kinds_.front().of_type};
  std::vector<Seen> seen;
  for (const Maps& maps : kinds_) {
    Problems known;  // problems of a map that was read before, to be discarded
    const bool fresh = std::ranges::find(told, maps.of_type) == told.end();
    const std::shared_ptr<void> own = default_settings(entry);
    read(entry, maps, own.get(), joints, fresh ? problems : known, &maps == &kinds_.front() ? known : problems);
    told.push_back(maps.of_type);
    seen.emplace_back();
    visit_settings(entry, own.get(), seen.back());
  }
  PerJointMerge merge(seen, of_joint_);
  visit_settings(entry, settings, merge);
  for (const std::string& key : merge.differing) {
    for (const Maps& maps : kinds_) {
      const Node* by = maps.of_hinge != nullptr && maps.of_hinge->find(key) != nullptr ? maps.of_hinge->find(key)
                       : maps.of_type != nullptr                                       ? maps.of_type->find(key)
                                                                                       : nullptr;
      if (by == nullptr) continue;
      problems.add(by->place, fmt::format("{} must be equal for all joints of a robot, but differs between its hinges", key));
      break;
    }
  }
}

std::vector<TypeFigures> stated_figures(Kind kind, const Robot& robot, const std::vector<Node>& documents) {
  std::vector<TypeFigures> stated;
  for (std::size_t type = 0; type < documents.size(); ++type) {
    const auto driven = [&](const Joint& joint) { return joint.driven() && robot.modules[joint.module].type == type; };
    if (std::ranges::none_of(robot.joints, driven)) continue;
    TypeFigures of{robot.types[type].name, type_of(map_of(documents[type], kind), kind), {}};
    for (const Node* map : preset_maps(documents[type], kind)) {
      for (const std::string& key : figures_of(map)) {
        if (std::ranges::find(of.keys, key) == of.keys.end()) of.keys.push_back(key);
      }
    }
    if (!of.keys.empty()) stated.push_back(std::move(of));
  }
  return stated;
}

}  // namespace gaitlab
