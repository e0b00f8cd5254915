// A file that appears whole or not at all, and is read whole.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace gaitlab {

/// Writes to `PATH.part` and gives it its name at commit(): write, fsync, close, rename, fsync of the folder, every return
/// checked. Destroyed without commit, or after a failure, it leaves neither PATH.part nor a changed PATH behind.
/// Every failure is a RunError `PATH: cannot be written: REASON`. A file size limit (RLIMIT_FSIZE) is such a failure only in a
/// program that ignores SIGXFSZ: the signal's default ends the process.
class AtomicFile {
 public:
  /// Opens PATH.part, replacing one that a killed run left.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends; unbuffered, so give it big pieces.
  void write(std::string_view bytes);
  /// Once, after the last write.
  void commit();

 private:
  [[noreturn]] void fail(int error);
  void discard();

  std::filesystem::path path_;
  std::filesystem::path part_;
  int descriptor_ = -1;
  bool pending_ = false;  // PATH.part exists and is ours to remove
};

/// The whole of `bytes` as the file `path`, or RunError and no change.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// What is there, links followed; not_found for nothing (and for a link to nothing).
/// InputError `PATH: error: cannot be read: REASON` where that cannot be told: no permission, a loop of links, too long a name.
std::filesystem::file_type kind_of(const std::filesystem::path& path);

/// All bytes of a file, of any size. InputError: `PATH: error: cannot be read: REASON`.
std::string read_file(const std::filesystem::path& path);

}  // namespace gaitlab
