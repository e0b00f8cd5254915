// Reader of one body in a module type.
#pragma once
#include "core/model/module_type.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Reads the keys of `body`, whose name is set. A missing inertia is computed from the body's shapes at uniform density; a
/// missing centre of mass is then the centre of the shapes. `place` is the place of the name.
void read_body(const Node& node, const SourceLocation& place, BodyType& body, Problems& problems);

}  // namespace gaitlab
