// Reasons why a text is not valid YAML, in terms of the user's text instead of the YAML rules that the parser names.
#pragma once
#include <string>

#include "core/errors.h"

namespace gaitlab {

/// Problem of a text that the parser refused in line `line` (from 1), such as a { that is not closed, or a line whose
/// indentation fits no earlier line. If no reason is found, the text of the problem is empty.
Problem yaml_fault(const std::string& text, const std::string& file, int line);

/// True if the quote at `position` of a text is closed, or if there is another character.
bool is_closed(const std::string& text, std::size_t position);

/// Message for a fault at `column` (from 0) of a line: the parser's words or, if these name a rule of YAML, the text found and
/// the text expected.
std::string yaml_fault_in_words(const std::string& parser, const std::string& line, std::size_t column);

}  // namespace gaitlab
