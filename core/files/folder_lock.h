// One process at a time writes to a folder.
#pragma once
#include <filesystem>

namespace gaitlab {

/// Holds a folder for as long as it lives: flock(2) of the folder itself, which leaves no file and ends with the process.
class FolderLock {
 public:
  /// Nothing is held until take().
  FolderLock() = default;
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// False: another process holds it. Where the file system knows no locks it says so on stderr, and holds nothing.
  [[nodiscard]] bool take(const std::filesystem::path& folder);

 private:
  int descriptor_ = -1;
};

}  // namespace gaitlab
