// Lock of a folder, so that one process at a time writes to it.
#pragma once
#include <filesystem>

namespace gaitlab {

/// Locks an open file or folder by flock(2), without waiting, until it is closed. False: another process holds the lock. On a
/// file system without locks it prints a note on stderr that names `folder`, once, and returns true.
[[nodiscard]] bool take_lock(int descriptor, const std::filesystem::path& folder);

/// Holds the lock of a folder during its lifetime: flock(2) of the folder itself, which leaves no file and ends with the
/// process.
class FolderLock {
 public:
  /// Not locked until take().
  FolderLock() = default;
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// False: another process holds the lock. File systems without locks: see take_lock().
  [[nodiscard]] bool take(const std::filesystem::path& folder);

 private:
  int descriptor_ = -1;
};

}  // namespace gaitlab
