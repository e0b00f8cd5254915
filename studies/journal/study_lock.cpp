#include "studies/journal/study_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "core/errors.h"
#include "core/files/folder_lock.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

namespace {

namespace fs = std::filesystem;

/// The first 300 bytes of a file, more than the longest lock text of this program.
std::string start_of(int descriptor) {
  std::array<char, 300> bytes{};
  const ssize_t size = ::pread(descriptor, bytes.data(), bytes.size(), 0);
  return {bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

/// The line `process 12 on HOST` of a lock; empty for any other text.
std::string holder_in(const std::string& text) {
  constexpr std::string_view kProcess = "process ";
  const std::size_t digits = text.find_first_not_of("0123456789", kProcess.size());
  const bool ours = text.starts_with(kProcess) && digits != std::string::npos && digits > kProcess.size() &&
                    text.compare(digits, 4, " on ") == 0 && text.find('\n') == text.size() - 1;
  return ours ? clipped(text.substr(0, text.size() - 1)) : "";
}

/// True if the descriptor is a regular file under one name.
bool is_plain(int descriptor) {
  struct stat about {};
  return ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode) && about.st_nlink == 1;
}

/// True if the descriptor is a regular file under one name, empty or with the line of a lock.
bool is_lock(int descriptor) {
  const std::string text = start_of(descriptor);
  return is_plain(descriptor) && (text.empty() || !holder_in(text).empty());
}

/// Opens a file without waiting for a FIFO and without following a link. Returns -1 and sets errno on failure.
int open_there(const fs::path& file, int how) {
  return ::open(file.c_str(), how | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY);
}

/// Creates the file, or opens the existing one.
int open_lock(const fs::path& file) {
  constexpr int kPatience = 100;  // number of attempts, because another process may remove the file between two calls
  for (int k = 0; k < kPatience; ++k) {
    int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
    descriptor = open_there(file, O_RDWR);
    if (descriptor >= 0 || errno != ENOENT) return descriptor;
  }
  return -1;
}

}  // namespace

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

Lock::Lock(fs::path file) : file_(std::move(file)) {
  const auto refuse = [&](const std::string& text) { return InputError(SourceLocation{file_.string()}, text); };
  constexpr const char* kNoLock =
      "is not the lock of a study; expected a regular file without other links, empty or with the line 'process N on HOST'. "
      "Move it away, or take another folder (--out)";
  descriptor_ = open_lock(file_);
  if (descriptor_ < 0 && errno == ELOOP) throw refuse(kNoLock);
  if (descriptor_ < 0) throw refuse("cannot be opened: " + std::generic_category().message(errno));
  try {
    if (!is_plain(descriptor_)) throw refuse(kNoLock);
    // A killed process may still exist when its successor begins, for example in a batch system that restarts a job.
    constexpr int kPatience = 50;  // number of attempts, 20 ms apart
    bool taken = take_lock(descriptor_, file_.parent_path());
    for (int k = 0; k < kPatience && !taken; ++k) {
      ::usleep(20000);
      taken = take_lock(descriptor_, file_.parent_path());
    }
    const std::string who = holder_in(start_of(descriptor_));
    if (!taken) {
      throw refuse((who.empty() ? "another process" : who) +
                   " is writing this study; wait for it, or see its results so far with `gaitlab study show`");
    }
    if (!is_lock(descriptor_)) throw refuse(kNoLock);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
  const std::string text = fmt::format("process {} on {}\n", ::getpid(), host());
  // The text is information only. A full disk is reported elsewhere.
  if (::ftruncate(descriptor_, 0) == 0) (void)!::pwrite(descriptor_, text.data(), text.size(), 0);
}

Lock::~Lock() {
  if (::ftruncate(descriptor_, 0) != 0) errno = 0;
  ::close(descriptor_);
}

std::string Lock::holder(const fs::path& file) {
  const int descriptor = open_there(file, O_RDONLY);
  if (descriptor < 0) return {};
  const bool held = is_plain(descriptor) && ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  std::string who = held ? holder_in(start_of(descriptor)) : "";
  ::close(descriptor);
  return who;
}

bool is_lock(const fs::path& file) {
  const int descriptor = open_there(file, O_RDONLY);
  const bool ours = descriptor >= 0 && is_lock(descriptor);
  if (descriptor >= 0) ::close(descriptor);
  return ours;
}

}  // namespace gaitlab::studies
