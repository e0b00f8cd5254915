#include "core/settings/file_of_name.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/files/atomic_file.h"
#include "core/files/files_read.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

namespace fs = std::filesystem;

/// True if both files can be read and have the same content.
bool same_content(const std::string& a, const std::string& b) {
  try {
    return read_file(a, kMostScenario) == read_file(b, kMostScenario);
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::optional<FileOfName> file_of_name(const std::vector<std::string>& own, const std::string& shipped) {
  std::error_code none;
  const bool ships = fs::exists(shipped, none);
  for (const std::string& path : own) {
    FilesRead::note(path);  // noted although missing, because a file made there later changes the robot
    if (!fs::exists(path, none) || fs::is_directory(path, none)) continue;
    return FileOfName{path, ships && !same_content(path, shipped) ? shipped : ""};
  }
  if (!ships) return {};
  return FileOfName{shipped};
}

std::string note_of_hidden(const std::string& name, const FileOfName& found) {
  if (found.hidden.empty()) return {};
  return fmt::format("{} is the file '{}', not the one of that name that comes with gaitlab", in_quotes(name), found.path);
}

}  // namespace gaitlab
