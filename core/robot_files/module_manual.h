// Manual, reference page and JSON Schema of module files, derived from the list of their keys.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/settings/explainer.h"

namespace gaitlab {

/// Keys of a module file; the indentation of a key shows its depth.
std::vector<KeyRow> module_rows();
/// Text of `gaitlab explain module`.
std::string explain_module_file();
/// Text of docs/reference/module.md.
std::string module_page();
/// JSON Schema of a module type, in a scenario or in a file.
nlohmann::ordered_json module_type_schema();

}  // namespace gaitlab
