// Search of a key over all sections of the scenario file.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"
#include "core/settings/explainer.h"
#include "core/settings/reader.h"

namespace gaitlab {

/// A key with its path, such as `ground.friction`. For a key of a plugin, the plugin.
struct ScenarioKey {
  std::string path;
  KeyRow row;
  const Entry* plugin = nullptr;
};

/// All keys of the scenario file, and of every plugin of the catalog.
std::vector<ScenarioKey> all_keys(const Catalog& catalog);

/// All keys of the module file.
std::vector<ScenarioKey> module_keys();

/// Search of unknown keys over all sections: `; did you mean ground.friction?`. A key of a plugin of another type than the
/// scenario's is named with its type. The result is empty if the known keys of the section say more. Catalog, root and scenario
/// must outlive the search.
Elsewhere key_search(const Catalog& catalog, const Node& root, const Scenario& scenario);

}  // namespace gaitlab
