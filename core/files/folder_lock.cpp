#include "core/files/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/errors.h"
#include "core/files/unnamed_file.h"

namespace gaitlab {

namespace {

/// Prints that a file system does not support locks, once for each folder.
void note_no_locks(const std::filesystem::path& folder, int error) {
  static std::string noted;  // last folder in a note; a study locks its folder first, then the file `lock` in this folder
  if (std::exchange(noted, folder.string()) == folder.string()) return;
  say(folder.string(), "note",
      fmt::format("the file system has no locks ({}); let one process at a time write here",
                  std::generic_category().message(error)));
}

}  // namespace

bool take_lock(int descriptor, const std::filesystem::path& folder) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK) return false;
  note_no_locks(folder, errno);
  return true;
}

bool has_record_locks(const std::filesystem::path& folder, bool noted) {
  const int descriptor = unnamed_file(folder);
  if (descriptor < 0) return true;
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  const bool locks = ::fcntl(descriptor, F_SETLK, &lock) == 0;
  const int error = errno;
  ::close(descriptor);
  if (!locks && noted) note_no_locks(folder, error);
  return locks;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool FolderLock::take(const std::filesystem::path& folder) {
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A process that cannot open the folder cannot write to it either.
  if (descriptor_ < 0 || take_lock(descriptor_, folder)) return true;
  ::close(std::exchange(descriptor_, -1));
  return false;
}

}  // namespace gaitlab
