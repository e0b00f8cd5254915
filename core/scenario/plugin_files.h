// Plugin libraries that a scenario names: search, check of the recorded hash, loading.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Reads `plugins`: a list of paths (relative to `folder`) or of {path, hash}; loads each library that the catalog trusts.
std::vector<PluginFile> read_plugins(const Node& node, const std::string& folder, Catalog& catalog, Problems& problems);

/// Loads a library that the command line names, relative to the current folder. Throws InputError.
void load_plugin_file(const std::string& path, Catalog& catalog);

/// A file that a section of a plugin in `folder` names and that messages may not quote; empty: none.
std::string hidden_file(const Node& section, const std::string& folder);

/// FNV-1a, 64 bits, of a file's bytes: 16 hex digits; empty if it cannot be read.
std::string file_hash(const std::string& path);

}  // namespace gaitlab
