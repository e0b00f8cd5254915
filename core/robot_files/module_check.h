// Check of a module type for one tree of bodies and hinges, physically possible inertias, and faces that can dock.
#pragma once
#include <vector>

#include "core/model/module_type.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Places of a module type's parts in its text. Each list has one entry per element of the list of equal name in ModuleType.
struct ModulePlaces {
  std::vector<SourceLocation> bodies;  ///< places of their names
  std::vector<Node> hinges, faces;     ///< maps of the hinges and of the faces
};

/// Checks a module type, normalises its directions and sets `type.root`.
void check_module(ModuleType& type, const ModulePlaces& places, Problems& problems);

}  // namespace gaitlab
