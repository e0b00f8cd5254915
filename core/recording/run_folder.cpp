#include "core/recording/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/errors.h"
#include "core/files/part_file.h"

namespace gaitlab {

namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

// Returns 0 or errno, by the rights of the effective user.
int cannot_write(const fs::path& folder) {
  return ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

}  // namespace

RunFolder::RunFolder(const std::optional<fs::path>& out, const std::string& name) {
  try {
    if (out) {
      use(*out);
    } else {
      number(name);
    }
  } catch (...) {
    remove_made();  // the destructor does not run after an exception of the constructor
    throw;
  }
}

RunFolder::~RunFolder() { remove_made(); }

void RunFolder::remove_made() {
  // rmdir refuses a folder that is not empty, so that files written so far are kept.
  while (!made_.empty() && ::rmdir(made_.back().c_str()) == 0) made_.pop_back();
  made_.clear();
}

// Returns 0 or errno.
int RunFolder::make(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0777) != 0) return errno;
  made_.push_back(folder);
  return 0;
}

int RunFolder::make_parents(const fs::path& folder) {
  fs::path grown;
  for (const fs::path& part : folder.parent_path()) {
    grown /= part;
    const int error = make(grown);
    // Some file systems return EROFS or EACCES for a folder that exists. Only missing folders matter.
    std::error_code ignored;
    const fs::file_status status = fs::status(grown, ignored);
    if (error == 0 || fs::is_directory(status)) continue;
    if (error != EEXIST) return error;
    return fs::exists(status) ? ENOTDIR : ENOENT;  // ENOENT if the folder is gone by now, or is a link to a missing folder
  }
  return 0;
}

void RunFolder::use(const fs::path& out) {
  const auto refuse = [&](const std::string& text) { return InputError(SourceLocation{"--out " + out.string()}, text); };
  if (out.empty()) throw refuse("is not a folder");
  path_ = out.has_filename() ? out : out.parent_path();  // `DIR/` means DIR
  int error = make_parents(path_);
  if (error == 0) error = make(path_);
  std::error_code code;
  const fs::file_status status = fs::status(path_, code);
  if (!fs::exists(status) && error != EEXIST) throw refuse("cannot be made: " + reason(error));
  if (!fs::is_directory(status)) throw refuse("exists and is not a folder");
  if (!lock_.take(path_)) {
    if (error == 0) made_.pop_back();  // the folder belongs to the other process now
    throw refuse("is being written by another process");
  }
  const fs::directory_iterator files(path_, code);
  if (code) throw refuse("cannot be read: " + code.message());
  if (!std::ranges::all_of(files, is_part_file)) throw refuse("exists and is not empty");
  if (const int denied = cannot_write(path_); denied != 0) throw refuse("cannot be written: " + reason(denied));
}

void RunFolder::number(const std::string& name) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
    throw InputError(SourceLocation{"name"}, fmt::format("\"{}\" cannot name a run folder", name));
  constexpr int kPatience = 100;  // another process may remove an empty `runs` between two calls of mkdir
  int vanished = 0;
  for (int k = 1;;) {
    path_ = fs::path("runs") / (k == 1 ? name : fmt::format("{}-{}", name, k));
    int error = make_parents(path_);
    if (error == 0) error = make(path_);
    if (error == 0 && lock_.take(path_)) return;
    if (error == 0) {
      made_.pop_back();  // another process uses the folder with --out
      error = EEXIST;
    }
    if (error == EEXIST) {
      ++k;
    } else if (error != ENOENT || ++vanished > kPatience) {
      throw InputError(SourceLocation{path_.string()}, "cannot be made: " + reason(error));
    }
  }
}

}  // namespace gaitlab
