// Manual of the scenario file and of the plugins: `gaitlab explain` and docs/reference.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// Every key of a scenario file with unit, default, range and sentence.
std::string explain_scenario(const Catalog& catalog);
/// A plugin's manual: its text, then a table of its fields. Throws PluginError.
std::string explain_plugin(const Entry& entry);

/// Step of an engine if the scenario gives none, in words: seconds, or auto with the alternatives.
std::string default_step(const Engine& engine);

/// The same as pages of Markdown: docs/reference/scenario.md, and plugins.md with every plugin and engine.
std::string scenario_page(const Catalog& catalog);
std::string plugins_page(const Catalog& catalog);

}  // namespace gaitlab
