// Text of an XML file of a robot: limits of its size, comments, places.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "core/errors.h"

namespace gaitlab::interchange {

/// Throws InputError for a text that is not UTF-8, has more than 10000 elements, or an element with more than 100 attributes:
/// the XML parsers of urdfdom and libmujoco call themselves for nested elements, and compare each attribute with all before it.
void check_xml(const std::string& text, const std::string& file);

/// The text with blanks in the place of comments, so that elements keep their lines and columns.
std::string without_comments(std::string text);

/// Line and column of an offset in the text.
SourceLocation place_in_text(std::string_view text, std::size_t offset, const std::string& file);

}  // namespace gaitlab::interchange
