// Files that are written completely or not at all, and read completely.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/files/spill.h"

namespace gaitlab {

/// Treatment of an existing file with the same name.
enum class Existing { replaced, refused };

/// Writer of a file PATH. Its bytes are written to a separate file `.NAME.XXXXXXXX.part` in the folder of PATH, which commit()
/// renames. The steps are write, fsync, close, rename, and fsync of the folder. Every return value is checked.
/// - Without commit(), or after a failure, the destructor removes the part file, and PATH is unchanged. Only kill -9 leaves the
///   part file. If only the last step fails, PATH is the new file, but a power cut may undo the rename.
/// - If several writers have the same path, the complete bytes of the last writer remain. With Existing::refused, the bytes of
///   the first writer remain, and all other writers throw.
/// - A device or a FIFO, also behind a link (/dev/stdout), is written to directly and never replaced. A FIFO needs a reader.
/// - Any other link is refused, because in a folder that others may write to, the link could lead anywhere.
/// Every failure is a RunError `PATH: cannot be written: REASON`, but a refused existing name is an InputError. Exceeding the
/// file size limit (RLIMIT_FSIZE) is such a failure only in a program that ignores SIGXFSZ, because this signal ends the
/// process by default.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path, Existing existing = Existing::replaced);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes without a buffer, so that large pieces are efficient.
  void write(std::string_view bytes);
  /// Completes the file. Call this once, after the last write.
  void commit();

 private:
  void open_stream();
  void open_part();
  int give_name();
  [[noreturn]] void fail(int error);
  [[noreturn]] void fail(const std::string& reason);
  void discard();

  std::filesystem::path path_, part_;
  Existing existing_;
  int descriptor_ = -1;
  bool stream_ = false;   // true if path_ is open for writing, as a device or FIFO
  bool pending_ = false;  // true if part_ exists and must be removed
};

/// Writes the file `path` with the content `bytes`. Throws RunError and leaves the file unchanged if it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view bytes, Existing existing = Existing::replaced);

/// Renames a file or folder to an unused name. Returns 0 or errno, which is EEXIST if the name is used.
int rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

/// Type of a file after links are followed. The type is not_found for a missing file, and for a link to a missing file. Throws
/// InputError `PATH: error: cannot be read: REASON` if the type cannot be determined, because of permissions, a loop of links
/// or a name that is too long.
std::filesystem::file_type kind_of(const std::filesystem::path& path);

// Upper limits of the sizes of files by kind, bytes.
inline constexpr std::uintmax_t kMostScenario = std::uintmax_t{1} << 20;  ///< files that a person writes
inline constexpr std::uintmax_t kMostJson = std::uintmax_t{1} << 24;      ///< summaries, goldens, verdicts
inline constexpr std::uintmax_t kMostPage = std::uintmax_t{1} << 28;      ///< pages, figures, plugins
inline constexpr std::uintmax_t kMostTrace = std::uintmax_t{1} << 34;     ///< traces; their header states their size

/// All bytes of a regular file. Opening never blocks. Throws InputError `PATH: error: cannot be read: REASON` for a device, a
/// FIFO, a folder, or more than `most` bytes, without reading anything.
std::string read_file(const std::filesystem::path& path, std::uintmax_t most);
/// As read_file(), for a file that may be larger than the memory.
SpilledVector<char> read_large_file(const std::filesystem::path& path, std::uintmax_t most);
/// The first bytes, at most `bytes`, of a regular file of any size. Throws InputError as read_file().
std::string read_start(const std::filesystem::path& path, std::size_t bytes);
/// Size of a regular file in bytes. Throws InputError as read_file().
std::uintmax_t size_of(const std::filesystem::path& path);

}  // namespace gaitlab
