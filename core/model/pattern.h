// Patterns for names of joints and columns, with the only pattern matcher of the project.
#pragma once
#include <string>

namespace gaitlab {

/// True if a text is a pattern and not a name. A pattern contains `*`, `?` or a range of whole numbers such as `[3-6]`, which
/// names never contain.
bool is_pattern(const std::string& text);

/// True if `text` matches `pattern`. `*` matches any run of characters, `?` a single character, `[3-6]` a
/// whole number from 3 to 6. Other brackets match themselves.
bool glob(const std::string& pattern, const std::string& text);

}  // namespace gaitlab
