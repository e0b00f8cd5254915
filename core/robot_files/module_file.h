// Module types, from a file of their own or a map in the scenario.
#pragma once
#include <string>

#include "core/model/module_type.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Reads and checks a module type; findings go to `problems`, and then the type is not to be used. `versioned`: the map stands
/// in a file of its own, which must say `gaitlab_module: 1` or 2 (docs/modules.md); one in the scenario that does not is of
/// format 1.
ModuleType read_module(const Node& document, bool versioned, Problems& problems);

struct ModuleFile {
  ModuleType type;
  Node document;
};
/// Reads and checks a module type file. Throws InputError with every problem found.
ModuleFile read_module_file(const std::string& path);

}  // namespace gaitlab
