#include "core/settings/data_folder.h"

#include <filesystem>

namespace gaitlab {

std::string data_folder() {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path installed = program.parent_path().parent_path() / "share" / "gaitlab" / "scenarios";
  return fs::is_directory(installed, none) ? installed.string() : GAITLAB_DATA_DIR;
}

}  // namespace gaitlab
