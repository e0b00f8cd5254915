#include "core/files/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/errors.h"

namespace gaitlab {

bool take_lock(int descriptor, const std::filesystem::path& folder) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
  const int error = errno;
  if (error == EWOULDBLOCK) return false;
  static std::string noted;  // the last folder in a note; a study locks its folder first, then the file `lock` in it
  if (std::exchange(noted, folder.string()) != folder.string()) {
    say(folder.string(), "note",
        fmt::format("the file system has no locks ({}); let one process at a time write here",
                    std::generic_category().message(error)));
  }
  return true;
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
