// Module types: what read_module_file and an inline map of the scenario share.
#pragma once
#include <string>

#include "core/model/module_type.h"
#include "core/scenario/node.h"

namespace gaitlab {

/// Reads and checks a module type; findings go to `problems`, and then the type is not to be used. `versioned`: the map stands
/// in a file of its own, which must say `gaitlab_module: 1`.
ModuleType read_module(const Node& document, bool versioned, Problems& problems);

}  // namespace gaitlab
