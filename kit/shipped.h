// Files that are shipped with the program, and names of them.
#pragma once
#include <map>
#include <string>

namespace gaitlab::kit {

/// Files that are shipped with the program, of `kind` module, robot, scenario or study, as a map from name to file.
std::map<std::string, std::string> shipped_files(const std::string& kind);
/// File that a user names: a path or, if there is no such file, the name of a shipped scenario or study. Throws
/// InputError for a name that is similar to one of them; other names are returned.
std::string named_file(const std::string& word);

}  // namespace gaitlab::kit
