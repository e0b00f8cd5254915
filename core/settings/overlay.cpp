#include "core/settings/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/model/pattern.h"
#include "core/plugin/plugin_instance.h"
#include "core/settings/explainer.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

constexpr std::string_view kOption = "--set ";
constexpr std::size_t kMaxPath = 16;

struct Setting {
  std::vector<std::string> path;
  Node value;
  SourceLocation place;
};

void move_to(Node& node, const SourceLocation& place) {
  node.place = place;
  node.source.reset();
  for (Node& item : node.items) move_to(item, place);
  for (auto& [key, key_place] : node.keys) key_place = place;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The value as a YAML node. Returns nothing, with a problem, if the value is invalid.
std::optional<Node> parse_value(const std::string& text, const SourceLocation& place, Problems& problems) {
  if (text.find('\n') != std::string::npos) {
    problems.add(place, "the value has several lines; expected one");
    return {};
  }
  try {
    Node root = parse_yaml("value: " + text + "\n", place.file);
    if (root.items.size() != 1) throw InputError(place, "expected one value");
    move_to(root.items[0], place);
    return std::move(root.items[0]);
  } catch (const InputError& e) {
    for (const Problem& problem : e.problems()) problems.add(place, problem.text);
  }
  return {};
}

std::optional<Setting> parse_set(const std::string& text, Problems& problems) {
  const SourceLocation place{std::string(kOption) + clipped(text)};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    problems.add(place, "found no '='; expected KEY.PATH=VALUE, for example physics.step=2.5e-05");
    return {};
  }
  std::vector<std::string> path = split(text.substr(0, equals));
  if (std::any_of(path.begin(), path.end(), [](const std::string& part) { return part.empty(); })) {
    problems.add(place, "found an empty key; expected KEY.PATH=VALUE, for example physics.step=2.5e-05");
    return {};
  }
  if (path.size() > kMaxPath) {
    problems.add(place, fmt::format("the path has {} keys; expected at most {}", path.size(), kMaxPath));
    return {};
  }
  std::optional<Node> value = parse_value(text.substr(equals + 1), place, problems);
  if (!value) return {};
  return Setting{std::move(path), std::move(*value), place};
}

Node* list_item(Node& list, const std::string& key, const std::string& where, const SourceLocation& place, Problems& problems) {
  Node number{Node::Kind::scalar, place};
  number.text = key;
  const Reading<std::int64_t> index = read_integer(number);
  if (index.ok() && index.value >= 0 && static_cast<std::size_t>(index.value) < list.items.size()) {
    return &list.items[static_cast<std::size_t>(index.value)];
  }
  problems.add(place, fmt::format("{} is a list of {}; {} is not an element (they are numbered from 0)", where,
                                  list.items.size(), in_quotes(key)));
  return nullptr;
}

Node& map_item(Node& map, const std::string& key, const SourceLocation& place) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i].first == key) return map.items[i];
  }
  map.keys.emplace_back(key, place);
  return map.items.emplace_back(Node{Node::Kind::null, place});
}

/// True if a key belongs to a value per joint: `m3/active`, a pattern, a group of the scenario, or `default`.
bool of_joints(const std::string& key, const Node& root) {
  const Node* groups = root.find("groups");
  return key == "default" || is_pattern(key) || key.find('/') != std::string::npos ||
         (groups != nullptr && groups->find(key) != nullptr);
}

/// Replaces a number by the equivalent map with the same value for every joint.
void spread(Node& number) {
  Node map{Node::Kind::map, number.place};
  map.keys.emplace_back("default", number.place);
  map.items.push_back(std::move(number));
  number = std::move(map);
}

void apply(Node& root, Setting& setting, Problems& problems) {
  Node* node = &root;
  std::string where;
  for (const std::string& key : setting.path) {
    if (node->kind == Node::Kind::null) {
      node->kind = Node::Kind::map;
      node->place = setting.place;
    }
    if (of_joints(key, root) && node->kind == Node::Kind::scalar && read_number(*node, "").ok()) spread(*node);
    if (node->kind == Node::Kind::scalar) {
      problems.add(setting.place,
                   fmt::format("{} is {}, a single value; it has no key {}", where, found(*node), in_quotes(key)));
      return;
    }
    node = node->kind == Node::Kind::list ? list_item(*node, key, where, setting.place, problems)
                                          : &map_item(*node, key, setting.place);
    if (node == nullptr) return;
    where += (where.empty() ? "" : ".") + clipped(key);
  }
  *node = std::move(setting.value);
}

bool sets_type(const Setting& setting) {
  return setting.path.size() == 2 && find_kind(setting.path[0]) != nullptr && setting.path[1] == "type";
}

std::optional<Retyped> retype(const Node& root, const Setting& setting) {
  const std::string& section = setting.path[0];
  const Node* given = root.find(section);
  if (given == nullptr || given->kind != Node::Kind::map) return {};
  const Node* type = given->find("type");
  std::string from = type == nullptr ? find_kind(section)->default_type : type->text;
  if (from == setting.value.text) return {};
  return Retyped{section, std::move(from), setting.value.text};
}

std::vector<std::string> known_keys(const Entry& entry) {
  Explainer explainer;
  visit_settings(entry, default_settings(entry).get(), explainer);
  std::vector<std::string> keys = explainer.keys();
  keys.insert(keys.end(), {"type", "period", "step"});
  return keys;
}

/// Text such as "model.mu, model.rate" for a map; otherwise the key alone.
std::string described(const std::string& key, const Node& value) {
  std::string out;
  for (const auto& [inner, place] : value.keys) out += (out.empty() ? "" : ", ") + clipped(key) + "." + clipped(inner);
  return out.empty() ? clipped(key) : out;
}

/// Removes the entries for which `gone` is true, and returns their names.
template <class Gone>
std::string take_out(Node& map, const std::string& prefix, Gone gone) {
  std::string dropped;
  for (std::size_t i = 0; i < map.keys.size();) {
    if (!gone(map.keys[i].first, map.items[i])) {
      ++i;
      continue;
    }
    dropped += (dropped.empty() ? "" : ", ") + prefix + described(map.keys[i].first, map.items[i]);
    map.keys.erase(map.keys.begin() + static_cast<std::ptrdiff_t>(i));
    map.items.erase(map.items.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return dropped;
}

std::string drop_from(Node& section, bool cpg, const std::vector<std::string>& known) {
  std::string dropped;
  for (std::size_t i = 0; cpg && i < section.keys.size(); ++i) {
    Node& model = section.items[i];
    if (section.keys[i].first != "model" || model.kind != Node::Kind::map) continue;
    dropped = take_out(model, "model.", [](const std::string&, const Node& value) { return !is_set(value); });
  }
  const std::string others = take_out(section, "", [&](const std::string& key, const Node& value) {
    const bool empty_model = cpg && key == "model" && value.kind == Node::Kind::map && value.items.empty();
    return !empty_model && !is_set(value) && std::find(known.begin(), known.end(), key) == known.end();
  });
  // A model that has lost all keys is removed without mention, because the message already contains these keys.
  take_out(section, "",
           [&](const std::string& key, const Node& value) { return cpg && key == "model" && value.items.empty(); });
  return dropped + (dropped.empty() || others.empty() ? "" : ", ") + others;
}

}  // namespace

bool is_set(const Node& node) { return node.place.file.starts_with(kOption); }

std::vector<Retyped> apply_sets(Node& root, const std::vector<std::string>& sets, Problems& problems) {
  std::vector<Setting> settings;
  for (const std::string& text : sets) {
    if (std::optional<Setting> setting = parse_set(text, problems)) settings.push_back(std::move(*setting));
  }
  std::stable_partition(settings.begin(), settings.end(), sets_type);
  std::vector<Retyped> retyped;
  for (Setting& setting : settings) {
    if (sets_type(setting)) {
      if (std::optional<Retyped> change = retype(root, setting)) retyped.push_back(std::move(*change));
    }
    apply(root, setting, problems);
  }
  return retyped;
}

void overlay(Node& root, const std::string& path, Node value, const SourceLocation& place, Problems& problems) {
  Setting setting{split(path), std::move(value), place};
  const bool whole = std::ranges::none_of(setting.path, [](const std::string& part) { return part.empty(); });
  if (!whole || setting.path.size() > kMaxPath) {
    problems.add(place, fmt::format("{} is not a key; expected SECTION.KEY, such as cpg.frequency", in_quotes(path)));
    return;
  }
  apply(root, setting, problems);
}

std::string drop_source(Node& root, const std::vector<std::string>& sets) {
  const auto figure = [](const std::string& set) {
    return set.starts_with("actuator.") && !set.starts_with("actuator.source=");
  };
  const auto fitted = [](const std::string& set) { return set.starts_with("controller.latency"); };
  const auto other = std::ranges::find_if(sets, figure);
  const auto section = std::ranges::find(root.keys, "actuator", [](const auto& key) { return key.first; });
  if (section == root.keys.end() || (other == sets.end() && std::ranges::none_of(sets, fitted))) return "";
  Node& actuator = root.items[static_cast<std::size_t>(section - root.keys.begin())];
  const auto stated = [](const std::string& name) {
    return [name](const std::string& key, const Node& value) { return key == name && !is_set(value); };
  };
  take_out(actuator, "", stated("identified"));  // not mentioned, because it is a part of the source
  const std::string dropped = other == sets.end() ? "" : take_out(actuator, "", stated("source"));
  return dropped.empty() ? "" : fmt::format("actuator: dropped source, which does not cover {}{}", kOption, clipped(*other));
}

std::string drop_engine_keys(Node& root, const std::vector<std::string>& sets, const Catalog& catalog) {
  constexpr std::string_view kEngine = "physics.engine=";
  const auto set = std::ranges::find_if(sets, [&](const std::string& one) { return one.starts_with(kEngine); });
  const auto section = std::ranges::find(root.keys, "physics", [](const auto& key) { return key.first; });
  if (set == sets.end() || section == root.keys.end()) return "";
  Node& physics = root.items[static_cast<std::size_t>(section - root.keys.begin())];
  const std::string name = physics.find("engine") == nullptr ? "" : physics.find("engine")->text;
  const Engine* engine = catalog.engine(name);
  if (engine == nullptr) return "";  // the reader of the section reports an unknown engine
  const std::vector<std::string> integrators = engine->integrator_names();
  const std::string dropped = take_out(physics, "", [&](const std::string& key, const Node& value) {
    return !is_set(value) && key == "integrator" && std::ranges::find(integrators, value.text) == integrators.end();
  });
  return dropped.empty() ? "" : fmt::format("physics: dropped {}, which engine {} does not have", dropped, clipped(name));
}

std::vector<std::string> drop_old_keys(Node& root, const std::vector<Retyped>& retyped, const Catalog& catalog) {
  std::vector<std::string> notes;
  for (const Retyped& change : retyped) {
    const Kind kind = find_kind(change.section)->kind;
    const Entry* entry = catalog.find(kind, change.to);
    if (entry == nullptr) continue;  // the reader of the section reports an unknown type
    for (std::size_t i = 0; i < root.keys.size(); ++i) {
      if (root.keys[i].first != change.section) continue;
      const std::string dropped = drop_from(root.items[i], kind == Kind::cpg, known_keys(*entry));
      if (dropped.empty()) continue;
      notes.push_back(fmt::format("{}: type changed from {} to {}; dropped {}", change.section, clipped(change.from),
                                  clipped(change.to), dropped));
    }
  }
  return notes;
}

}  // namespace gaitlab
