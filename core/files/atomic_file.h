// A file that appears whole or not at all, and is read whole.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace gaitlab {

/// Treatment of an existing file of the same name.
enum class Existing { replaced, refused };

/// Writes to a separate file beside PATH, `.NAME.XXXXXXXX.part`, which only this process has open, and renames it at commit():
/// write, fsync, close, rename, fsync of the folder, every return value checked. Without commit, or after a failure, the
/// destructor removes that file and PATH is unchanged; only kill -9 leaves the file. If several writers have one path, the last
/// one's bytes remain, whole; with Existing::refused the first one's, and the others throw. A device or a FIFO, also behind a
/// link (/dev/stdout), is written into and never replaced; a FIFO needs a reader. Any other link is refused: in a folder that
/// others may write to it could lead anywhere. Every failure is a RunError `PATH: cannot be written: REASON`, except an
/// existing name that is refused: InputError. Exceeding a file size limit (RLIMIT_FSIZE) is such a failure only in a program
/// that ignores SIGXFSZ: the signal's default ends the process.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path, Existing existing = Existing::replaced);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends; unbuffered, so pass large pieces.
  void write(std::string_view bytes);
  /// Call once, after the last write.
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
  bool stream_ = false;   // path_ itself is open
  bool pending_ = false;  // part_ exists and has to be removed
};

/// Writes the file `path` with the content `bytes`; RunError without a change.
void write_file(const std::filesystem::path& path, std::string_view bytes, Existing existing = Existing::replaced);

/// Renames a file or a folder to an unused name. Returns 0 or errno, mostly EEXIST.
int rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

/// Type of the file, links followed; not_found for a missing file (and for a link to one). Throws InputError `PATH: error:
/// cannot be read: REASON` if the type cannot be determined: no permission, a loop of links, too long a name.
std::filesystem::file_type kind_of(const std::filesystem::path& path);

// Upper limits of the sizes of files by kind, bytes.
inline constexpr std::uintmax_t kMostScenario = std::uintmax_t{1} << 20;  ///< files that a person writes
inline constexpr std::uintmax_t kMostJson = std::uintmax_t{1} << 24;      ///< summaries, goldens, verdicts
inline constexpr std::uintmax_t kMostPage = std::uintmax_t{1} << 28;      ///< pages, figures, plugins
inline constexpr std::uintmax_t kMostTrace = std::uintmax_t{1} << 34;     ///< traces; their header states their size

/// All bytes of a regular file; opening never blocks. Throws InputError `PATH: error: cannot be read: REASON`, also if it is a
/// device, a FIFO or a folder, or has more than `most` bytes, and then reads nothing.
std::string read_file(const std::filesystem::path& path, std::uintmax_t most);
/// Its first bytes, at most `bytes`, of a file of any size.
std::string read_start(const std::filesystem::path& path, std::size_t bytes);
/// Size in bytes. InputError as above.
std::uintmax_t size_of(const std::filesystem::path& path);

}  // namespace gaitlab
