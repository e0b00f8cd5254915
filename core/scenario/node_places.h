// Where a character of a scalar stands in the file.
#pragma once
#include <cstddef>

#include "core/scenario/node.h"

namespace gaitlab {

/// Place of the byte `offset` of a scalar's text (its size: just behind the last character) for plain and quoted scalars in one
/// line and for block scalars (`|`). Where the text cannot be followed (folded over several lines, given by --set), the
/// scalar's own place.
Place place_in(const Node& scalar, std::size_t offset);

}  // namespace gaitlab
