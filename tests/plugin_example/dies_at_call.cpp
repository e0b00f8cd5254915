// Library for LD_PRELOAD that ends the process, like kill -9, at call number GAITLAB_DIES_AT (counted from 1) of the functions
// that change files, in the process and its children. A write at this call writes its first half. A gate can thus kill a
// program at each of these calls on machines of any speed. With GAITLAB_DIES_TOGETHER, all processes of the group end. Instead
// of the end, call number GAITLAB_FAILS_AT fails as on a damaged disk (EIO), and with GAITLAB_FAILS_ON this call and all later
// ones, except removals, as on a full disk (ENOSPC).
#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
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

/// Number of a call in an environment variable; 0 if there is none.
int number(const char* variable) {
  const char* text = std::getenv(variable);
  return text == nullptr ? 0 : std::atoi(text);
}

enum class Kind { change, removal };
enum class Fate { goes_on, dies, fails };

Fate fate_of_next(Kind kind) {
  const int last = number("GAITLAB_DIES_AT"), first = number("GAITLAB_FAILS_AT");
  if (last == 0 && first == 0) return Fate::goes_on;
  const int call = ++calls;
  if (call == last) return Fate::dies;
  const bool full = first > 0 && call >= first && std::getenv("GAITLAB_FAILS_ON") != nullptr;
  if (full ? kind == Kind::removal : call != first) return Fate::goes_on;
  errno = full ? ENOSPC : EIO;
  return Fate::fails;
}

int end_of(Fate fate) {
  return fate == Fate::fails ? -1 : ::kill(std::getenv("GAITLAB_DIES_TOGETHER") == nullptr ? ::getpid() : 0, SIGKILL);
}

// Original function that a function of this library replaces.
template <typename Function>
Function* hidden(Function*, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

template <typename Function, typename... Arguments>
int call(Kind kind, Function* replaced, const char* name, Arguments... arguments) {
  const Fate fate = fate_of_next(kind);
  return fate == Fate::goes_on ? hidden(replaced, name)(arguments...) : end_of(fate);
}

}  // namespace

extern "C" ssize_t write(int file, const void* data, size_t size) {
  const auto next = hidden(&write, "write");
  const Fate fate = file <= STDERR_FILENO ? Fate::goes_on : fate_of_next(Kind::change);
  if (fate == Fate::goes_on) return next(file, data, size);
  if (fate == Fate::dies) (void)next(file, data, size / 2);
  return end_of(fate);
}

extern "C" ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) {
  const auto next = hidden(&pwrite64, "pwrite64");
  const Fate fate = fate_of_next(Kind::change);
  if (fate == Fate::goes_on) return next(file, data, size, at);
  if (fate == Fate::dies) (void)next(file, data, size / 2, at);
  return end_of(fate);
}

extern "C" int fsync(int file) { return call(Kind::change, &fsync, "fsync", file); }
extern "C" int rename(const char* from, const char* to) noexcept { return call(Kind::change, &rename, "rename", from, to); }
extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  return call(Kind::change, &renameat2, "renameat2", from_folder, from, to_folder, to, flags);
}
extern "C" int unlinkat(int folder, const char* name, int flags) noexcept {
  return call(Kind::removal, &unlinkat, "unlinkat", folder, name, flags);
}
extern "C" int unlink(const char* name) noexcept { return call(Kind::removal, &unlink, "unlink", name); }
extern "C" int mkdir(const char* name, mode_t mode) noexcept { return call(Kind::change, &mkdir, "mkdir", name, mode); }
