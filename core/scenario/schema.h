// JSON Schema (draft 7, for editors) of the scenario file, derived from the same declared fields as its reader.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// Schema as indented text. The reader refuses everything that the schema refuses, and has further checks (joint names, fit of
/// the parts). Throws PluginError.
std::string scenario_schema(const Catalog& catalog);

}  // namespace gaitlab
