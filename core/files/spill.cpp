#include "core/files/spill.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <limits>
#include <new>

#include "core/files/unnamed_file.h"

namespace gaitlab {

namespace {

/// Reserves the space on the disk. Without a reserve, a full disk would cause a signal (SIGBUS) at the first access to a page.
bool reserve(int descriptor, off_t bytes) {
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(descriptor, 0, bytes);
  return error == 0;
}

}  // namespace

std::filesystem::path spill_folder() {
  const char* const chosen = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): nothing sets variables
  return chosen != nullptr && *chosen != '\0' ? chosen : "/var/tmp";
}

void* map_spilled(std::size_t bytes) {
  if (bytes > std::numeric_limits<std::size_t>::max() / 2) throw std::bad_alloc();
  const int descriptor = unnamed_file(spill_folder());
  const int in_memory = descriptor < 0 ? MAP_ANONYMOUS : 0;
  void* mapped = MAP_FAILED;
  if (in_memory != 0 || reserve(descriptor, static_cast<off_t>(bytes)))
    mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | in_memory, descriptor, 0);
  if (descriptor >= 0) ::close(descriptor);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  return mapped;
}

void unmap_spilled(void* from, std::size_t bytes) noexcept { ::munmap(from, bytes); }

void release_spilled(const void* from, std::size_t bytes) noexcept {
  ::madvise(const_cast<void*>(from), bytes, MADV_DONTNEED);  // keeps the content, because the mapping is shared
}

}  // namespace gaitlab
