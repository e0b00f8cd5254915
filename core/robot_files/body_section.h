// Bodies of a module type, from the keys that were read.
#pragma once
#include "core/robot_files/module_keys.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Checks the keys of a body and fills in its shapes and its inertia. A missing inertia is that of the body's shapes at uniform
/// density, and a missing centre of mass then is their centre. `place`: place of the name; `read` is false if
/// reading the keys found a fault. Returns true if the body does not have a fault.
bool complete_body(const Node& node, const SourceLocation& place, bool read, BodyKeys& body, Problems& problems);

}  // namespace gaitlab
