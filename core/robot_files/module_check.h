// Check of a module type: one tree of bodies and hinges, physical inertias, faces that can dock.
#pragma once
#include <cstdint>
#include <vector>

#include "core/model/module_type.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Places of a module type's parts in its text, in the type's order.
struct ModulePlaces {
  std::vector<SourceLocation> bodies;  ///< places of their names
  std::vector<Node> hinges, faces;     ///< their maps
  std::int64_t format = 1;             ///< of the text
};

/// Checks, normalises directions and sets `type.root`.
void check_module(ModuleType& type, const ModulePlaces& places, Problems& problems);

}  // namespace gaitlab
