// Reader of module types, from a separate file or from a map in the scenario.
#pragma once
#include <string>

#include "core/model/module_type.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Reads and checks a module type. If it adds problems, the type must not be used. If `versioned`, the map is a separate file,
/// which must contain `gaitlab_module: 1` (docs/modules.md).
ModuleType read_module(const Node& document, bool versioned, Problems& problems);

struct ModuleFile {
  ModuleType type;
  Node document;
};
/// Reads and checks a module type file. Throws InputError with every problem found.
ModuleFile read_module_file(const std::string& path);

}  // namespace gaitlab
