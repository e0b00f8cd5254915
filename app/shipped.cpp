#include <filesystem>

#include "app/app.h"
#include "core/settings/data_folder.h"

namespace gaitlab::app {

std::map<std::string, std::string> shipped_files(const std::string& kind) {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> files;
  const fs::path folder = fs::path(data_folder()) / (kind + "s");
  std::error_code none;  // an installation without data has an empty list
  for (const auto& file : fs::directory_iterator(folder, none)) files[file.path().stem().string()] = file.path().string();
  return files;
}

}  // namespace gaitlab::app
