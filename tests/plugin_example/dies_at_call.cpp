// Library for LD_PRELOAD that ends the process, like kill -9, at call number GAITLAB_DIES_AT (counted from 1) of the functions
// that change files, in the process and its children. A write at this call writes its first half. A gate can thus kill a
// program at each of these calls on machines of any speed. With GAITLAB_DIES_TOGETHER, all processes of the group end.
#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

using Counter = std::atomic<int>;

/// A counter that child processes share.
Counter& shared_counter() {
  return *new (::mmap(nullptr, sizeof(Counter), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) Counter(0);
}
Counter& calls = shared_counter();

bool is_the_last() {
  const char* last = std::getenv("GAITLAB_DIES_AT");
  return last != nullptr && ++calls == std::atoi(last);
}

int dies() { return ::kill(std::getenv("GAITLAB_DIES_TOGETHER") == nullptr ? ::getpid() : 0, SIGKILL); }

// Original function that a function of this library replaces.
template <typename Function>
Function* hidden(Function*, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" ssize_t write(int file, const void* data, size_t size) {
  const auto next = hidden(&write, "write");
  if (file <= STDERR_FILENO || !is_the_last()) return next(file, data, size);
  (void)next(file, data, size / 2);
  return dies();
}

extern "C" ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) {
  const auto next = hidden(&pwrite64, "pwrite64");
  if (!is_the_last()) return next(file, data, size, at);
  (void)next(file, data, size / 2, at);
  return dies();
}

extern "C" int fsync(int file) { return is_the_last() ? dies() : hidden(&fsync, "fsync")(file); }
extern "C" int rename(const char* from, const char* to) noexcept {
  return is_the_last() ? dies() : hidden(&rename, "rename")(from, to);
}
extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  return is_the_last() ? dies() : hidden(&renameat2, "renameat2")(from_folder, from, to_folder, to, flags);
}
extern "C" int unlinkat(int folder, const char* name, int flags) noexcept {
  return is_the_last() ? dies() : hidden(&unlinkat, "unlinkat")(folder, name, flags);
}
extern "C" int unlink(const char* name) noexcept { return is_the_last() ? dies() : hidden(&unlink, "unlink")(name); }
extern "C" int mkdir(const char* name, mode_t mode) noexcept {
  return is_the_last() ? dies() : hidden(&mkdir, "mkdir")(name, mode);
}
