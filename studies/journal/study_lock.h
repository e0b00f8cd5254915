// The file `lock` of a study or shard, which admits one writing process at a time.
#pragma once
#include <filesystem>
#include <string>

namespace gaitlab::studies {

/// Keeps a file locked during the lifetime of this object. The file contains the number of the locking process and its host.
class Lock {
 public:
  /// Creates the file, or locks the existing one, which must be a regular file under one name, empty or with the line `process
  /// N on HOST`. Throws InputError if the file is anything else, or if another process keeps the lock for a second: `PATH:
  /// error: process 12 on HOST is writing this study`. take_lock() describes file systems without locks.
  explicit Lock(std::filesystem::path file);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  /// Holder of the lock as `process N on HOST`, or "" if the file is not locked.
  static std::string holder(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// True if a file is the lock of a study, locked or not: a regular file under one name, empty or with the line `process N on
/// HOST`.
bool is_lock(const std::filesystem::path& file);

/// Name of this machine.
std::string host();

}  // namespace gaitlab::studies
