// One process at a time writes to a folder.
#pragma once
#include <filesystem>

namespace gaitlab {

/// flock(2) of an open file or folder, without waiting, until it is closed. False: another process holds it. On a file system
/// without locks a note on stderr names `folder`, once, and the result is true.
[[nodiscard]] bool take_lock(int descriptor, const std::filesystem::path& folder);

/// Holds a folder for as long as it lives: flock(2) of the folder itself, which leaves no file and ends with the process.
class FolderLock {
 public:
  /// Nothing is held until take().
  FolderLock() = default;
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// False: another process holds it. File systems without locks: see take_lock().
  [[nodiscard]] bool take(const std::filesystem::path& folder);

 private:
  int descriptor_ = -1;
};

}  // namespace gaitlab
