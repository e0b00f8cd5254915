#include "core/scenario/key_lookup.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/plugin/plugin_instance.h"
#include "core/robot_files/module_manual.h"
#include "core/scenario/manual.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

/// Adds rows. The indentation of a key shows its depth. All paths begin with `before`.
void add_rows(const std::vector<KeyRow>& rows, const std::string& before, const Entry* plugin, std::vector<ScenarioKey>& keys) {
  std::vector<std::string> path;
  for (const KeyRow& row : rows) {
    const std::size_t indent = std::min(row.key.find_first_not_of(' '), row.key.size());
    path.resize(indent / 2);
    path.push_back(row.key.substr(indent, row.key.find(':') - indent));
    keys.push_back({before + fmt::format("{}", fmt::join(path, ".")), row, plugin});
  }
}

std::string name_of_key(const std::string& path) { return path.substr(path.rfind('.') + 1); }

/// Types that a scenario selects, in the order of kPluginKinds; "" for a kind without a selected type.
using TypesInForce = std::array<std::string, kPluginKinds.size()>;

/// True for a key that is allowed in the scenario without other changes.
bool applies(const ScenarioKey& key, const TypesInForce& types) {
  if (key.plugin == nullptr) return key.path.find('[') == std::string::npos;
  const auto* const kind = std::ranges::find(kPluginKinds, key.plugin->kind, &PluginKind::kind);
  const std::string& in_force = types[static_cast<std::size_t>(kind - kPluginKinds.begin())];
  return in_force.empty() || in_force == key.plugin->name;
}

std::vector<std::string> paths_of(const std::vector<ScenarioKey>& keys, const std::string& name) {
  std::vector<std::string> paths;
  for (const ScenarioKey& key : keys) {
    if (name_of_key(key.path) == name && std::ranges::find(paths, key.path) == paths.end()) paths.push_back(key.path);
  }
  return paths;
}

/// `; Kp is a key of controller pid` for a key of plugins of other types than the scenario's.
std::string of_other_types(const std::vector<ScenarioKey>& keys, const std::string& name) {
  std::vector<std::string> types;
  std::optional<Kind> last;  // each kind is named only once
  const Entry* seen = nullptr;
  for (const ScenarioKey& key : keys) {
    if (key.plugin == nullptr || key.plugin == seen || name_of_key(key.path) != name) continue;
    seen = key.plugin;
    const std::string kind = last == key.plugin->kind ? "" : std::string(word(key.plugin->kind)) + " ";
    types.push_back(kind + std::string(key.plugin->name));
    last = key.plugin->kind;
  }
  return types.empty() ? "" : fmt::format("; {} is a key of {}", name, joined(types));
}

/// Type that a scenario selects for this kind of plugin; "" if none is selected.
std::string type_in_force(Kind kind, const Node& root, const Scenario& scenario) {
  const Node* section = root.find(word(kind));
  const Node* type = section == nullptr ? nullptr : section->find("type");
  if (type != nullptr) return type->text;
  const PluginSelection& selection = kind == Kind::cpg          ? scenario.cpg
                                     : kind == Kind::controller ? scenario.controller
                                                                : scenario.actuator;
  return selection.entry == nullptr ? "" : std::string(selection.entry->name);
}

/// `; did you mean ground.friction?` for some paths of keys; "" for no paths, and for too many.
std::string did_you_mean(const UnknownKey& unknown, const std::vector<std::string>& paths) {
  constexpr std::size_t kMost = 4;
  if (paths.empty() || paths.size() > kMost) return "";
  if (paths.front() == unknown.key)  // `unknown` is a whole section, or a key outside of sections
    return fmt::format("; {} belongs to the top level of the file, beside {}", unknown.key, clipped(unknown.section));
  return fmt::format("; did you mean {}?", fmt::join(paths, " or "));
}

/// True for a key of the sections that repeat the names of other keys.
bool repeats(const std::string& path) {
  return path.starts_with(std::string(kTolerancesSection) + ".") || path.starts_with(std::string(kAsBuiltSection) + ".");
}

std::string elsewhere(const Catalog& catalog, const TypesInForce& types, const UnknownKey& unknown) {
  const std::string own = unknown.section + (unknown.section.empty() ? "" : ".") + unknown.key;
  const std::vector<ScenarioKey> all = all_keys(catalog);
  std::vector<ScenarioKey> usable;
  // A key with the path of the unknown key is of no use: the section has this key only under other settings.
  std::ranges::copy_if(all, std::back_inserter(usable),
                       [&](const ScenarioKey& one) { return one.path != own && applies(one, types); });
  const std::vector<std::string> exact = paths_of(usable, unknown.key);
  std::vector<std::string> first = exact;
  std::erase_if(first, repeats);
  if (repeats(own)) return "";  // offers the keys of the section instead
  const auto of_this_section = [&](const ScenarioKey& one) {
    return one.plugin != nullptr && word(one.plugin->kind) == unknown.section && name_of_key(one.path) == unknown.key;
  };
  if (std::ranges::any_of(all, of_this_section)) return of_other_types(all, unknown.key);
  if (std::string found = did_you_mean(unknown, first); !found.empty()) return found;
  if (!unknown.near.empty()) return "";
  if (std::string found = of_other_types(all, unknown.key); !found.empty()) return found;
  if (std::string found = did_you_mean(unknown, exact); !found.empty()) return found;
  std::vector<std::string> names;
  for (const ScenarioKey& one : usable) names.push_back(name_of_key(one.path));
  return did_you_mean(unknown, paths_of(usable, nearest(unknown.key, names)));
}

}  // namespace

std::vector<ScenarioKey> all_keys(const Catalog& catalog) {
  std::vector<ScenarioKey> keys;
  add_rows(scenario_keys(catalog), "", nullptr, keys);
  for (const PluginKind& kind : kPluginKinds) {
    if (kind.kind == Kind::sensor) continue;  // keys of sensors do not have a fixed path, because sensors have names
    for (const std::string& name : catalog.names(kind.kind)) {
      const Entry* entry = catalog.find(kind.kind, name);
      add_rows(plugin_keys(*entry), std::string(kind.section) + ".", entry, keys);
    }
  }
  return keys;
}

std::vector<ScenarioKey> module_keys() {
  std::vector<ScenarioKey> keys;
  add_rows(module_rows(), "", nullptr, keys);
  return keys;
}

Elsewhere key_search(const Catalog& catalog, const Node& root, const Scenario& scenario) {
  return [&](const UnknownKey& unknown) {
    try {
      TypesInForce types;
      std::ranges::transform(kPluginKinds, types.begin(),
                             [&](const PluginKind& one) { return type_in_force(one.kind, root, scenario); });
      return elsewhere(catalog, types, unknown);
    } catch (const PluginError&) {  // ignored, because the scenario does not use this plugin
      return std::string();
    }
  };
}

}  // namespace gaitlab
