#include "core/settings/data_folder.h"

#include <dlfcn.h>
#include <sys/auxv.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

namespace gaitlab {

namespace {

namespace fs = std::filesystem;

constexpr const char* kBelow = "share/gaitlab/scenarios";  // below the installation prefix

/// Possible paths of the file that contains this code: the library or program according to the loader, and the program
/// according to the kernel (also without /proc) and to /proc.
std::vector<fs::path> own_files() {
  std::vector<fs::path> files;
  Dl_info loaded = {};
  if (dladdr(reinterpret_cast<const void*>(&data_folder), &loaded) != 0 && loaded.dli_fname != nullptr)
    files.emplace_back(loaded.dli_fname);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the kernel gives the address as a number
  const auto* started = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  if (started != nullptr) files.emplace_back(started);
  std::error_code none;
  files.push_back(fs::read_symlink("/proc/self/exe", none));
  return files;
}

fs::path find_prefix() {
  for (const fs::path& file : own_files()) {
    std::error_code none;
    const fs::path own = file.has_parent_path() ? fs::canonical(file, none) : fs::path();
    for (fs::path folder = own.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
      if (fs::is_directory(folder / kBelow, none)) return folder;
    }
  }
  return {};
}

/// Prefix of an installation that contains the file with this code: the folder above the file's folder, as in
/// PREFIX/bin/gaitlab.
fs::path wanted_prefix() {
  for (const fs::path& file : own_files()) {
    std::error_code none;
    const fs::path own = file.has_parent_path() ? fs::canonical(file, none) : fs::path();
    if (!own.empty()) return own.parent_path().parent_path();
  }
  return "/usr";
}

}  // namespace

std::string installation_prefix() {
  static const std::string prefix = find_prefix().string();  // once: a relative path is invalid in another folder
  return prefix;
}

std::string data_folder() {
  std::error_code none;
  if (const std::string prefix = installation_prefix(); !prefix.empty())
    return fs::canonical(fs::path(prefix) / kBelow, none).string();
  const char* given = std::getenv("GAITLAB_DATA");  // NOLINT(concurrency-mt-unsafe): nothing sets variables
  if (given != nullptr && *given != '\0') return fs::absolute(given, none).string();
  static const std::string missing = (wanted_prefix() / kBelow).string();
  return missing;
}

}  // namespace gaitlab
