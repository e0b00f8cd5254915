// The file `lock` of a study, or of one of its shards, for one writing process at a time.
#pragma once
#include <filesystem>
#include <string>

namespace gaitlab::studies {

/// Holds the lock of a file during its lifetime; the file names the holder.
class Lock {
 public:
  /// Creates the file, or takes an existing lock: a regular file, with one name, empty or with the line `process N on HOST`.
  /// Throws InputError if it is something else, or if another process holds it for a second: `PATH: error: process 12 on HOST
  /// is writing this study`. File systems without locks: see take_lock().
  explicit Lock(std::filesystem::path file);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  /// Holder of the lock, or "".
  static std::string holder(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Checks that a file is the lock of a study, held or free: regular, with one name, empty or with such a line.
bool is_lock(const std::filesystem::path& file);

/// Name of this machine.
std::string host();

}  // namespace gaitlab::studies
