// Place in the file for a character of a scalar.
#pragma once
#include <cstddef>
#include <string_view>

#include "core/settings/node.h"

namespace gaitlab {

/// Place of the byte `offset` of a scalar's text, for plain and quoted scalars on one line and for block scalars (`|`). An
/// offset equal to the text's size is the place after the last character. The result for any other scalar, such as one folded
/// over several lines or given by --set, is the place of the scalar.
SourceLocation place_in(const Node& scalar, std::size_t offset);

/// Adds a problem at the place of the byte `offset`. If place_in() cannot find that place, the message contains the character's
/// number.
void add_in(const Node& scalar, std::size_t offset, std::string_view what, Problems& problems);

}  // namespace gaitlab
