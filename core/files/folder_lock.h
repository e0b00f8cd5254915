// Lock of a folder, so that only one process at a time writes to it.
#pragma once
#include <filesystem>

namespace gaitlab {

/// Locks an open file or folder by flock(2) until it is closed. Does not wait: returns false if another process has the lock.
/// On a file system without locks, prints one note on stderr with the name of `folder`, and returns true.
[[nodiscard]] bool take_lock(int descriptor, const std::filesystem::path& folder);

/// True if files in a folder can be locked by fcntl(2), which SQLite uses, or if no file can be made in the folder. If the
/// result is false and `noted` is true, prints the note of take_lock() on stderr, unless the last note named this folder.
[[nodiscard]] bool has_record_locks(const std::filesystem::path& folder, bool noted);

/// Keeps a folder locked during the lifetime of this object, by flock(2) of the folder. The lock leaves no file and ends with
/// the process.
class FolderLock {
 public:
  /// Makes an object without a lock; take() locks a folder.
  FolderLock() = default;
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Locks a folder. Returns false if another process has the lock. take_lock() describes file systems without locks.
  [[nodiscard]] bool take(const std::filesystem::path& folder);

 private:
  int descriptor_ = -1;
};

}  // namespace gaitlab
