// The plugin libraries a scenario names: found, checked against their recorded hash, loaded.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Reads `plugins`: a list of paths (relative to `folder`) or of {path, hash}; loads each into the catalog, if that trusts it.
std::vector<PluginFile> read_plugins(const Node& node, const std::string& folder, Catalog& catalog, Problems& problems);

/// Loads one that the command line names, relative to the current folder. Throws InputError.
void load_plugin_file(const std::string& path, Catalog& catalog);

/// FNV-1a, 64 bits, of a file's bytes: 16 hex digits; empty where it cannot be read.
std::string file_hash(const std::string& path);

}  // namespace gaitlab
