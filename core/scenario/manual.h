// What the program knows about its scenario file and its plugins, for people: `gaitlab explain` and docs/reference.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// Every key of a scenario file with unit, default, range and sentence.
std::string explain_scenario(const Catalog& catalog);
/// A plugin's manual: its text, then a table of its fields. Throws PluginError.
std::string explain_plugin(const Entry& entry);

/// What an engine takes where a scenario gives no step: seconds, or auto and what else there is.
std::string default_step(const Engine& engine);

/// The same as pages of Markdown: docs/reference/scenario.md, and plugins.md with every plugin and engine.
std::string scenario_page(const Catalog& catalog);
std::string plugins_page(const Catalog& catalog);

}  // namespace gaitlab
