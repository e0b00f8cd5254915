// Plugin libraries of a scenario: search, comparison with the recorded hash, and loading.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Reads `plugins`, a list of paths (relative to `folder`) or of maps {path, hash}. Loads each library that the catalog trusts.
std::vector<PluginFile> read_plugins(const Node& node, const std::string& folder, Catalog& catalog, Problems& problems);

/// Path of the library that a text in `folder` names. Candidates are the libraries of this file name from the command line and
/// those already loaded, then the path relative to `folder`. The result is the first candidate with the hash of the text. If
/// the text does not have a hash, or no candidate has this hash, the result is the path relative to `folder` if it exists, else
/// the first candidate.
std::string plugin_path(const PluginFile& file, const std::string& folder, const Catalog& catalog);

/// Loads a library that the command line names. Its path is relative to the current folder. Throws InputError.
void load_plugin_file(const std::string& path, Catalog& catalog);

/// Path of the first file in `section`, a plugin's section of a scenario, whose content messages must not quote (may_quote()),
/// or "" if there is none. Relative paths start at `folder`, the folder of the scenario.
std::string hidden_file(const Node& section, const std::string& folder);

/// FNV-1a hash (64 bit) of a file's bytes as 16 hex digits, or "" if the file cannot be read.
std::string file_hash(const std::string& path);

}  // namespace gaitlab
