// Record of the files that a part of the program reads.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace gaitlab {

/// State of a file. If the content changes, at least one of the numbers changes. All are 0 if the file cannot be read.
struct FileStamp {
  std::int64_t modified = 0;  ///< ns
  std::uint64_t size = 0, inode = 0;
  bool operator==(const FileStamp&) const = default;
};
FileStamp stamp_of(const std::filesystem::path& path);

struct FileRead {
  std::filesystem::path path;  ///< absolute
  FileStamp stamp;             ///< at the first reading
};

/// Collects the files that read_file() and read_text() open or try to open during the lifetime of this object, in all threads.
/// Each file is listed once. Only one object may exist at a time.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;
  [[nodiscard]] std::vector<FileRead> files() const;

  /// Called by the functions that read files.
  static void note(const std::filesystem::path& path);
};

}  // namespace gaitlab
