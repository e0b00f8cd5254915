#include "report/analysis/plugin_names.h"

#include <filesystem>

namespace gaitlab::report {

std::string without_folders(std::string text, const std::vector<PluginFile>& plugins) {
  for (const PluginFile& plugin : plugins) {
    const std::string name = std::filesystem::path(plugin.path).filename().string();
    for (std::size_t at = 0; (at = text.find(plugin.path, at)) != std::string::npos; at += name.size())
      text.replace(at, plugin.path.size(), name);
  }
  return text;
}

}  // namespace gaitlab::report
