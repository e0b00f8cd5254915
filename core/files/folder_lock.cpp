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

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool FolderLock::take(const std::filesystem::path& folder) {
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return true;  // who cannot open it cannot write it
  if (errno == EWOULDBLOCK) {
    ::close(std::exchange(descriptor_, -1));
    return false;
  }
  say(folder.string(), "note",
      fmt::format("the file system has no locks ({}); let one process at a time write here",
                  std::generic_category().message(errno)));
  return true;
}

}  // namespace gaitlab
