// JSON Schemas (draft 7, for editors) of scenario and module files, derived from the declared fields that their readers also
// use.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// Schema as indented text. The reader refuses everything that the schema refuses, and also checks joint names and the fit of
/// the parts. Throws PluginError.
std::string scenario_schema(const Catalog& catalog);

/// Schema of a module file, with the keys of the actuators and controllers of the catalog. Throws PluginError.
std::string module_schema(const Catalog& catalog);

}  // namespace gaitlab
