// Search for a key in all sections of the scenario file.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"
#include "core/settings/explainer.h"
#include "core/settings/reader.h"

namespace gaitlab {

/// A key with its path, such as `ground.friction`. `plugin` is set for a key of a plugin.
struct ScenarioKey {
  std::string path;
  KeyRow row;
  const Entry* plugin = nullptr;
};

/// All keys of the scenario file, and of every plugin of the catalog.
std::vector<ScenarioKey> all_keys(const Catalog& catalog);

/// All keys of the module file.
std::vector<ScenarioKey> module_keys();

/// Search for unknown keys in all sections: `; did you mean ground.friction?`. If a plugin of another type than the scenario's
/// has the key, the result contains this type. The result is empty if a list of the section's known keys helps more. Catalog,
/// root and scenario must outlive the search.
Elsewhere key_search(const Catalog& catalog, const Node& root, const Scenario& scenario);

}  // namespace gaitlab
