// Plugin libraries that a scenario names: search, comparison with the recorded hash, and loading.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Reads `plugins`, a list of paths (relative to `folder`) or of maps {path, hash}. Loads each library that the catalog trusts.
std::vector<PluginFile> read_plugins(const Node& node, const std::string& folder, Catalog& catalog, Problems& problems);

/// Path of a library that a text in `folder` names. If the text has a hash, it is the file of that name and hash among those
/// that the command line names, those already loaded, and the one relative to `folder`. Else, or if none has the hash, it is
/// the one relative to `folder`, if it exists, or the first of the others.
std::string plugin_path(const PluginFile& file, const std::string& folder, const Catalog& catalog);

/// Loads a library that the command line names. Its path is relative to the current folder. Throws InputError.
void load_plugin_file(const std::string& path, Catalog& catalog);

/// Path of the first file that `section`, a plugin's section of a scenario, names and whose content messages must not quote
/// (may_quote()), or "" without such a file. Relative paths start at `folder`, the folder of the scenario.
std::string hidden_file(const Node& section, const std::string& folder);

/// FNV-1a hash (64 bit) of a file's bytes as 16 hex digits, or "" if the file cannot be read.
std::string file_hash(const std::string& path);

}  // namespace gaitlab
