// Plugin libraries in texts of a result: a folder is not part of a run.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/plugin_files.h"

namespace gaitlab::report {

/// The text with every path of a plugin library cut down to the name of its file.
std::string without_folders(std::string text, const std::vector<PluginFile>& plugins);

}  // namespace gaitlab::report
