#include "core/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <type_traits>
#include <utility>

#include "core/errors.h"
#include "core/files/files_read.h"
#include "core/files/part_file.h"

namespace gaitlab {

namespace {

constexpr std::size_t kReadPiece = std::size_t{1} << 20;  // bytes; keeps the number of system calls small

// Syncs a file. Returns 0 or errno. An interruption by a signal is not a failure.
int sync(int descriptor) {
  while (::fsync(descriptor) != 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

// Syncs a folder, so that a rename in it survives a power cut. Returns 0 or errno.
int sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  int error = sync(descriptor);
  if (error == EINVAL || error == ENOTSUP) error = 0;  // file systems that cannot sync a folder give these errors
  if (::close(descriptor) != 0 && error == 0 && errno != EINTR) error = errno;
  return error;
}

/// True if a link such as /dev/stdout leads through /proc to an open file of any kind.
bool names_what_is_open(std::filesystem::path path) {
  constexpr int kMostLinks = 40;  // the limit of Linux
  constexpr long kProc = 0x9FA0;
  std::error_code error;
  for (int k = 0; k < kMostLinks && std::filesystem::is_symlink(path, error); ++k) {
    struct statfs about {};
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (::statfs(folder.c_str(), &about) == 0 && about.f_type == kProc) return true;
    path = folder / std::filesystem::read_symlink(path, error);
  }
  return false;
}

/// A regular file, open for reading.
class Regular {
 public:
  explicit Regular(const std::filesystem::path& path)
      : path_(path), file_{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)} {
    const int error = errno;
    FilesRead::note(path_);
    if (file_.descriptor < 0) fail(std::generic_category().message(error));
    struct stat about {};
    if (::fstat(file_.descriptor, &about) != 0) fail(std::generic_category().message(errno));
    if (S_ISDIR(about.st_mode)) fail(std::generic_category().message(EISDIR));
    if (!S_ISREG(about.st_mode)) fail("not a regular file");
    size_ = static_cast<std::uintmax_t>(about.st_size);
  }
  [[nodiscard]] std::uintmax_t size() const { return size_; }

  /// Reads at most `most` bytes, even if the file has grown.
  template <class Bytes>
  [[nodiscard]] Bytes read(std::uintmax_t most) const {
    Bytes text;
    text.reserve(std::min(most, size_ + kReadPiece));
    while (text.size() < most) {
      const std::size_t had = text.size();
      const std::size_t piece = std::min<std::uintmax_t>(kReadPiece, most - had);
      text.resize(had + piece);
      const ssize_t got = ::read(file_.descriptor, text.data() + had, piece);
      const int error = errno;
      text.resize(had + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
      if constexpr (!std::is_same_v<Bytes, std::string>) release(text);
      if (got == 0) break;
      if (got < 0 && error != EINTR) fail(std::generic_category().message(error));
    }
    return text;
  }

 private:
  /// Closes the file, even if the constructor throws.
  struct Open {
    int descriptor;
    explicit Open(int from) : descriptor(from) {}
    ~Open() {
      if (descriptor >= 0) ::close(descriptor);
    }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;
  };

  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(SourceLocation{path_.string()}, "cannot be read: " + reason);
  }

  std::filesystem::path path_;
  Open file_;
  std::uintmax_t size_ = 0;
};

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path, Existing existing) : path_(std::move(path)), existing_(existing) {
  struct stat named {};
  struct stat there {};
  const bool exists = ::lstat(path_.c_str(), &named) == 0;
  const bool leads = exists && ::stat(path_.c_str(), &there) == 0;
  if (leads && S_ISDIR(there.st_mode)) fail(EISDIR);
  stream_ = leads && (!S_ISREG(there.st_mode) || names_what_is_open(path_));
  if (exists && !stream_ && existing_ == Existing::refused) fail(EEXIST);
  if (exists && !stream_ && S_ISLNK(named.st_mode)) fail("is a link; name the file that it leads to");
  stream_ ? open_stream() : open_part();
}

/// With O_NONBLOCK, a FIFO without a reader is an error instead of a wait.
void AtomicFile::open_stream() {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0 && errno == ENXIO) fail("no process reads this FIFO");
  if (descriptor_ < 0) fail(errno);
  ::fcntl(descriptor_, F_SETFL, ::fcntl(descriptor_, F_GETFL) & ~O_NONBLOCK);
}

void AtomicFile::open_part() {
  constexpr int kPatience = 100;  // number of names tried
  for (int k = 0; descriptor_ < 0; ++k) {
    std::uint64_t random = 0;
    if (::getrandom(&random, sizeof random, 0) < 0) fail(errno);
    part_ = path_.parent_path() / part_name(path_.filename().string(), random);
    descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && (errno != EEXIST || k == kPatience)) fail(errno);
  }
  pending_ = true;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      fail(errno);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  int error = stream_ ? 0 : sync(descriptor_);
  if (error != 0) fail(error);
  // On Linux, close() closes the descriptor even if it fails. EINTR does not affect the data, which are already synced.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
  if (stream_) return;
  if ((error = give_name()) != 0) fail(error);
  pending_ = false;
  const std::filesystem::path folder = path_.parent_path();
  if ((error = sync_folder(folder.empty() ? "." : folder)) != 0) fail(error);
}

/// Renames the part file to the final name. Returns 0 or errno.
int AtomicFile::give_name() {
  if (existing_ == Existing::refused) return rename_new(part_, path_);
  return ::rename(part_.c_str(), path_.c_str()) == 0 ? 0 : errno;
}

void AtomicFile::fail(int error) {
  if (error == EEXIST && existing_ == Existing::refused) {
    discard();
    throw InputError(SourceLocation{path_.string()}, "exists; nothing was written");
  }
  fail(std::generic_category().message(error));
}

void AtomicFile::fail(const std::string& reason) {
  discard();
  throw RunError(fmt::format("{}: cannot be written: {}", path_.string(), reason));
}

void AtomicFile::discard() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (std::exchange(pending_, false)) ::unlink(part_.c_str());
}

int rename_new(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) return errno;
  // The file system does not support RENAME_NOREPLACE. An empty file or folder therefore reserves the name and is then
  // replaced.
  if (std::filesystem::is_directory(from)) {
    if (::mkdir(to.c_str(), 0777) != 0) return errno;
  } else {
    const int claim = ::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (claim < 0) return errno;
    ::close(claim);
  }
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

void write_file(const std::filesystem::path& path, std::string_view bytes, Existing existing) {
  AtomicFile file(path, existing);
  file.write(bytes);
  file.commit();
}

std::filesystem::file_type kind_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::none)
    throw InputError(SourceLocation{path.string()}, "cannot be read: " + std::generic_category().message(error.value()));
  return type;
}

namespace {

template <class Bytes>
Bytes read_whole(const std::filesystem::path& path, std::uintmax_t most) {
  const Regular file(path);
  if (file.size() > most) {
    throw InputError(SourceLocation{path.string()},
                     fmt::format("cannot be read: it has {} bytes; expected at most {}", file.size(), most));
  }
  return file.read<Bytes>(most + 1);
}

}  // namespace

std::string read_file(const std::filesystem::path& path, std::uintmax_t most) { return read_whole<std::string>(path, most); }

SpilledVector<char> read_large_file(const std::filesystem::path& path, std::uintmax_t most) {
  return read_whole<SpilledVector<char>>(path, most);
}

std::string read_start(const std::filesystem::path& path, std::size_t bytes) { return Regular(path).read<std::string>(bytes); }

std::uintmax_t size_of(const std::filesystem::path& path) { return Regular(path).size(); }

}  // namespace gaitlab
