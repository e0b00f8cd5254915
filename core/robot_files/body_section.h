// Reader of a body of a module type.
#pragma once
#include "core/model/module_type.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Reads the keys of the body whose name `body` has. A missing inertia is that of the body's shapes at uniform density,
/// and a missing centre of mass then is their centre. `place` is that of the name.
void read_body(const Node& node, const SourceLocation& place, BodyType& body, Problems& problems);

}  // namespace gaitlab
