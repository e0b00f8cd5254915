// Reader of a body of a module type.
#pragma once
#include <cstdint>

#include "core/model/module_type.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Reads the keys of the body whose name `body` has. From format 3 on, a missing inertia is that of the body's shapes at
/// uniform density, and a missing centre of mass then is their centre. `place` is that of the name. `format` 0 means that the
/// format is not known, which has been reported. Returns false, without a problem, if the inertia is missing and would follow
/// from shapes in a newer format.
bool read_body(const Node& node, const SourceLocation& place, std::int64_t format, BodyType& body, Problems& problems);

}  // namespace gaitlab
