#include "report/analysis/plugin_names.h"

#include <filesystem>
#include <vector>

namespace gaitlab::report {

std::string without_folders(std::string text, const Scenario& scenario) {
  std::vector<std::string> paths;
  for (const PluginFile& plugin : scenario.plugins) paths.push_back(plugin.path);
  const Heightfield* relief = scenario.ground.relief();
  if (relief != nullptr && !relief->source.file.empty()) paths.push_back(relief->source.file);
  for (const std::string& path : paths) {
    const std::string name = std::filesystem::path(path).filename().string();
    for (std::size_t at = 0; (at = text.find(path, at)) != std::string::npos; at += name.size())
      text.replace(at, path.size(), name);
  }
  return text;
}

}  // namespace gaitlab::report
