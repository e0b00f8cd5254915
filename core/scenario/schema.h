// The JSON Schema (draft 7, which editors read) of the scenario file, from the same walk as its reader.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// As text, indented. What it refuses, the reader refuses; the reader knows more (joint names, fit of the parts). Throws
/// PluginError.
std::string scenario_schema(const Catalog& catalog);

}  // namespace gaitlab
