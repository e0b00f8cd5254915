// Reasons why a text is not valid YAML, in the words of the user's text, where the parser names a rule of YAML.
#pragma once
#include <string>

#include "core/errors.h"

namespace gaitlab {

/// The problem of a text that the parser refused in line `line` (from 1), such as a { that is not closed, or a line whose
/// indentation fits no earlier line. Without such a reason the text of the problem is empty.
Problem yaml_fault(const std::string& text, const std::string& file, int line);

/// True if the quote at `position` of a text is closed, or if there is another character.
bool is_closed(const std::string& text, std::size_t position);

/// The words of the parser for a fault at `column` (from 0) of a line, or, for those that name a rule of YAML, what was found
/// and what is expected.
std::string yaml_fault_in_words(const std::string& parser, const std::string& line, std::size_t column);

}  // namespace gaitlab
