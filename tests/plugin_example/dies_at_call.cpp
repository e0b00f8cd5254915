// Library for LD_PRELOAD that ends the process, like kill -9, at call number GAITLAB_DIES_AT (counted from 1) of the functions
// that change files. A write at this call writes its first half. A gate can thus kill a program at each of these calls on
// machines of any speed.
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace {

bool is_the_last() {
  static std::atomic<int> calls = 0;
  const char* last = std::getenv("GAITLAB_DIES_AT");
  return last != nullptr && ++calls == std::atoi(last);
}

int dies() { return ::kill(::getpid(), SIGKILL); }

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
extern "C" int unlink(const char* name) noexcept { return is_the_last() ? dies() : hidden(&unlink, "unlink")(name); }
extern "C" int mkdir(const char* name, mode_t mode) noexcept {
  return is_the_last() ? dies() : hidden(&mkdir, "mkdir")(name, mode);
}
