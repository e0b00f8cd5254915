// Manual, reference page and JSON Schema of module files, derived from the list of their keys.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace gaitlab {

/// Text of `gaitlab explain module`.
std::string explain_module_file();
/// Text of docs/reference/module.md.
std::string module_page();
/// JSON Schema of a module type, in a scenario or in a file.
nlohmann::ordered_json module_type_schema();

}  // namespace gaitlab
