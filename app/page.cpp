// Checks of paths for new pages.
#include <fmt/format.h>

#include "app/shell/commands.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"

namespace gaitlab::app {

void check_new(const std::string& name) {
  namespace fs = std::filesystem;
  if (name.empty()) throw InputError(SourceLocation{"FILE"}, "is an empty name");
  const fs::path file = name;
  const fs::file_type kind = kind_of(file);
  if (kind == fs::file_type::character || kind == fs::file_type::fifo) return;  // written to, not replaced
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error))) throw InputError(SourceLocation{name}, "exists; nothing was written");
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) throw InputError(SourceLocation{name}, "cannot be written: its folder does not exist");
}

Existing check_page(const std::string& name, const std::filesystem::path& own) {
  std::error_code none;  // a missing file counts as new
  if (std::filesystem::equivalent(name, own, none)) return Existing::replaced;
  check_new(name);
  return Existing::refused;
}

void print_page(const std::filesystem::path& file) { fmt::print("  {:<9} {}\n", "page", one_line(file.string())); }

}  // namespace gaitlab::app
