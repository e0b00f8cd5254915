// Folder that is created for one run, and removed again if it stays empty.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/folder_lock.h"

namespace gaitlab {

/// Owns the folder from its creation to keep(), and locks it during the lifetime of this object. If two processes use the same
/// folder, the second process is refused. If destroyed before keep(), the object removes the folders that it created and that
/// are empty. Files, and folders that existed before, are not removed.
class RunFolder {
 public:
  /// Without `out`, creates `runs/NAME` in the working folder, or the first of NAME-2, NAME-3 ... that does not exist. mkdir
  /// decides, so that two simultaneous processes get different folders. If `out` is given, uses that folder and creates its
  /// parents. The folder must not exist, or must be empty except for part files of a killed run. Throws InputError `--out DIR:
  /// error: exists and is not empty`, `... is not a folder`, `... cannot be made: REASON`, `... cannot be written: REASON`,
  /// `... is being written by another process`, or for a name that cannot name a folder.
  RunFolder(const std::optional<std::filesystem::path>& out, const std::string& name);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Marks the folder as permanent.
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
