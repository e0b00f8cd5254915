// Scenarios, studies and folders that the command line names.
#pragma once
#include <string>

namespace gaitlab::kit {

/// File that a user names: a path or, if there is no such file, the name of a shipped scenario or study. A folder is not a
/// scenario. Prints a note if both exist. Throws InputError for an unknown name that is similar to a shipped one; other names
/// are returned unchanged.
std::string named_file(const std::string& word);
/// The same for commands that take a run folder, and for those that take any folder.
std::string named_file_or_run(const std::string& word);
std::string named_file_or_folder(const std::string& word);

}  // namespace gaitlab::kit
