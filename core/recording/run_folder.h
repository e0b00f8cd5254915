// The folder of one run: made for it, and gone again if nothing came of it.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/folder_lock.h"

namespace gaitlab {

/// Owns the folder from its making to keep(), and holds its lock for as long as it lives: of two processes that take the same
/// folder the second one is refused. Destroyed before keep(), it removes the folders it made itself as far as they are
/// empty: nothing written is lost, nothing it did not make is touched.
class RunFolder {
 public:
  /// Without `out`: `runs/NAME` in the working folder, or the first of NAME-2, NAME-3 ... that does not exist (mkdir decides:
  /// two processes at once get different ones). With `out`: that folder, which must be empty or not exist; parents are made.
  /// InputError: `--out DIR: error: exists and is not empty`, `... is not a folder`, `... cannot be made: REASON`,
  /// `... cannot be written: REASON`, `... is being written by another process`; a name that cannot be a folder's.
  RunFolder(const std::optional<std::filesystem::path>& out, const std::string& name);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// From now on the folder stays.
  void keep() { made_.clear(); }

 private:
  void use(const std::filesystem::path& out);
  void number(const std::string& name);
  int make_parents(const std::filesystem::path& folder);
  int make(const std::filesystem::path& folder);
  void remove_made();

  std::filesystem::path path_;
  FolderLock lock_;
  std::vector<std::filesystem::path> made_;  // outermost first
};

}  // namespace gaitlab
