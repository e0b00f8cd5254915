// A file that appears whole or not at all, and is read whole.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace gaitlab {

/// What happens to a file that has the name.
enum class Existing { replaced, refused };

/// Writes to a file of its own beside PATH, `.NAME.XXXXXXXX.part`, which nobody else has open, and gives it its name at
/// commit(): write, fsync, close, rename, fsync of the folder, every return checked. Destroyed without commit, or after a
/// failure, it leaves neither that file nor a changed PATH behind; only kill -9 leaves the former. Of several writers of one
/// path the last one's bytes are there, whole; with Existing::refused the first one's, and the others throw.
/// A device or a FIFO, also behind a link (/dev/stdout), is written into and never replaced; a FIFO needs a reader. Any other
/// link is refused: in a folder that others may write to it could lead anywhere.
/// Every failure is a RunError `PATH: cannot be written: REASON`, but for a name that exists and is refused: InputError. A file
/// size limit (RLIMIT_FSIZE) is such a failure only in a program that ignores SIGXFSZ: the signal's default ends the process.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path, Existing existing = Existing::replaced);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends; unbuffered, so give it big pieces.
  void write(std::string_view bytes);
  /// Once, after the last write.
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
  bool pending_ = false;  // part_ exists and is ours to remove
};

/// The whole of `bytes` as the file `path`, or RunError and no change.
void write_file(const std::filesystem::path& path, std::string_view bytes, Existing existing = Existing::replaced);

/// Gives a file or a folder a name that nothing has: 0, or errno, EEXIST above all.
int rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

/// What is there, links followed; not_found for nothing (and for a link to nothing).
/// InputError `PATH: error: cannot be read: REASON` where that cannot be told: no permission, a loop of links, too long a name.
std::filesystem::file_type kind_of(const std::filesystem::path& path);

// bytes: more than a file of this kind ever has
inline constexpr std::uintmax_t kMostScenario = std::uintmax_t{1} << 20;  ///< whatever a person writes
inline constexpr std::uintmax_t kMostJson = std::uintmax_t{1} << 24;      ///< summaries, goldens, verdicts
inline constexpr std::uintmax_t kMostPage = std::uintmax_t{1} << 28;      ///< pages, figures, plugins
inline constexpr std::uintmax_t kMostTrace = std::uintmax_t{1} << 34;     ///< traces; their own header says more

/// All bytes of a regular file, which opening never waits for. InputError: `PATH: error: cannot be read: REASON`, also where it
/// is a device, a FIFO or a folder, or has more than `most` bytes: then nothing of it is read.
std::string read_file(const std::filesystem::path& path, std::uintmax_t most);
/// At most its first bytes, of a file of any size.
std::string read_start(const std::filesystem::path& path, std::size_t bytes);
/// bytes. InputError as above.
std::uintmax_t size_of(const std::filesystem::path& path);

}  // namespace gaitlab
