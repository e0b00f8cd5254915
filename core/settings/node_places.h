// Location in the file of a character of a scalar.
#pragma once
#include <cstddef>
#include <string_view>

#include "core/settings/node.h"

namespace gaitlab {

/// Place of the byte `offset` of a scalar's text (its size: just behind the last character), for plain and quoted scalars on
/// one line and for block scalars (`|`). For other scalars (folded over several lines, given by --set) the scalar's place.
SourceLocation place_in(const Node& scalar, std::size_t offset);

/// Adds a problem there; for such other scalars the message contains the character's number.
void add_in(const Node& scalar, std::size_t offset, std::string_view what, Problems& problems);

}  // namespace gaitlab
