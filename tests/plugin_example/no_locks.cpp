// Library for LD_PRELOAD with which files cannot be locked, as on a file system without locks.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>

namespace {

/// Fails with the error number GAITLAB_LOCK_ERROR, or ENOLCK.
int refused() {
  const char* number = std::getenv("GAITLAB_LOCK_ERROR");
  errno = number != nullptr ? std::atoi(number) : ENOLCK;
  return -1;
}

bool locks(int command) {
  return command == F_SETLK || command == F_SETLKW || command == F_GETLK || command == F_OFD_SETLK || command == F_OFD_SETLKW ||
         command == F_OFD_GETLK;
}

int passed_on(const char* name, int file, int command, void* argument) {
  if (locks(command)) return refused();
  return reinterpret_cast<int (*)(int, int, void*)>(::dlsym(RTLD_NEXT, name))(file, command, argument);
}

}  // namespace

extern "C" int flock(int, int) noexcept { return refused(); }

extern "C" int fcntl(int file, int command, ...) {
  va_list more;
  va_start(more, command);
  void* const argument = va_arg(more, void*);
  va_end(more);
  return passed_on("fcntl", file, command, argument);
}

extern "C" int fcntl64(int file, int command, ...) {
  va_list more;
  va_start(more, command);
  void* const argument = va_arg(more, void*);
  va_end(more);
  return passed_on("fcntl64", file, command, argument);
}
