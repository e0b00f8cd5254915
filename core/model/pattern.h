// Patterns of names, of joints and of columns: the one matcher of the project.
#pragma once
#include <string>

namespace gaitlab {

/// Whether a user's text is a pattern and not a name: it contains `*` or `?`, which names never do.
bool is_pattern(const std::string& text);

/// `*` stands for any run of characters, `?` for one.
bool glob(const std::string& pattern, const std::string& text);

}  // namespace gaitlab
