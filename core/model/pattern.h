// Patterns for names of joints and columns, with the only matcher of the project.
#pragma once
#include <string>

namespace gaitlab {

/// True if a text is a pattern and not a name. A pattern contains `*` or `?`, which names never contain.
bool is_pattern(const std::string& text);

/// True if `text` matches `pattern`. `*` matches any run of characters, `?` a single character.
bool glob(const std::string& pattern, const std::string& text);

}  // namespace gaitlab
