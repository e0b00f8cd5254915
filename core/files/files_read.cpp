#include "core/files/files_read.h"

#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <mutex>

namespace gaitlab {

namespace {

std::atomic<bool> collecting = false;
std::mutex mutex;  // guards the files
std::vector<FileRead> collected;

}  // namespace

FileStamp stamp_of(const std::filesystem::path& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return {};
  constexpr std::int64_t kSecond = 1'000'000'000;  // ns
  return {about.st_mtim.tv_sec * kSecond + about.st_mtim.tv_nsec, static_cast<std::uint64_t>(about.st_size), about.st_ino};
}

FilesRead::FilesRead() {
  const std::lock_guard lock(mutex);
  collected.clear();
  collecting = true;
}

FilesRead::~FilesRead() { collecting = false; }

std::vector<FileRead> FilesRead::files() const {
  const std::lock_guard lock(mutex);
  return collected;
}

void FilesRead::note(const std::filesystem::path& path) {
  if (!collecting) return;
  std::error_code none;
  const std::filesystem::path absolute = std::filesystem::absolute(path, none);
  const std::lock_guard lock(mutex);
  if (none || std::ranges::find(collected, absolute, &FileRead::path) != collected.end()) return;
  collected.push_back({absolute, stamp_of(absolute)});
}

}  // namespace gaitlab
