// Where a character of a scalar stands in the file.
#pragma once
#include <cstddef>
#include <string_view>

#include "core/settings/node.h"

namespace gaitlab {

/// SourceLocation of the byte `offset` of a scalar's text (its size: just behind the last character) for plain and quoted
/// scalars in one line and for block scalars (`|`). Where the text cannot be followed (folded over several lines, given by
/// --set), the scalar's own place.
SourceLocation place_in(const Node& scalar, std::size_t offset);

/// A problem there; where the text cannot be followed, the character's number is told.
void add_in(const Node& scalar, std::size_t offset, std::string_view what, Problems& problems);

}  // namespace gaitlab
