// Manual of the scenario file and of the plugins: `gaitlab explain` and docs/reference.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/settings/explainer.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Keys of a scenario file, without the keys of plugins, and keys of a plugin. Both throw PluginError.
std::vector<KeyRow> scenario_keys(const Catalog& catalog);
std::vector<KeyRow> plugin_keys(const Entry& entry);

/// Text with every key of a scenario file, with unit, default, range and sentence.
std::string explain_scenario(const Catalog& catalog);
/// Manual of a plugin: its text, followed by a table of its fields. Throws PluginError.
std::string explain_plugin(const Entry& entry, std::size_t width = 80);

/// Unit of the number at a path of keys in a scenario, such as `rad` for cpg.amplitude. `scenario` sets the types of plugins.
/// Empty if the number has no unit, or if the catalog does not have its plugin. Throws PluginError.
std::string unit_of_key(const Catalog& catalog, const Node& scenario, const std::string& key);

/// Text on the step that an engine uses if the scenario sets no step: a number of seconds, or `auto` with the alternatives.
std::string default_step(const Engine& engine);

/// Pages in Markdown: docs/reference/scenario.md, and docs/reference/plugins.md with every plugin and engine.
std::string scenario_page(const Catalog& catalog);
std::string plugins_page(const Catalog& catalog);

}  // namespace gaitlab
