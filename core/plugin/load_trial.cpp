#include "core/plugin/load_trial.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "core/files/child_process.h"

namespace gaitlab {

namespace {

constexpr int kThrew = 3;          // exit code of the child
constexpr rlim_t kTrialTime = 10;  // s of CPU time

/// A flag that the child sets when dlopen has returned. An exit code cannot state this, because a static object may call
/// exit().
class SharedFlag {
 public:
  SharedFlag() : page_(::mmap(nullptr, sizeof(char), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {}
  ~SharedFlag() {
    if (made()) ::munmap(page_, sizeof(char));
  }
  SharedFlag(const SharedFlag&) = delete;
  SharedFlag& operator=(const SharedFlag&) = delete;

  [[nodiscard]] bool made() const { return page_ != MAP_FAILED; }
  void set() { *static_cast<volatile char*>(page_) = 1; }
  [[nodiscard]] bool is_set() const { return *static_cast<volatile char*>(page_) != 0; }

 private:
  void* page_;
};

/// CPU time after which the child is killed, s: kTrialTime, or less if this process has less.
rlim_t trial_time() {
  rlimit own{};
  return ::getrlimit(RLIMIT_CPU, &own) == 0 ? std::min(kTrialTime, own.rlim_cur) : kTrialTime;
}

/// Ends this process after the time of a trial: by SIGXCPU or, if a static object ignores it, by SIGKILL a second later.
void limit_time() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_CPU, &limit) != 0) return;
  limit.rlim_cur = std::min(kTrialTime, limit.rlim_cur);
  limit.rlim_max = std::min(kTrialTime + 1, limit.rlim_max);
  std::signal(SIGXCPU, SIG_DFL);
  (void)::setrlimit(RLIMIT_CPU, &limit);  // lowers the limits, which is always allowed
}

/// Loads the library and ends the process.
[[noreturn]] void load_and_end(const std::string& path, SharedFlag& loaded) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  limit_time();
  std::set_terminate([] { std::_Exit(kThrew); });
  // dlopen is declared not to throw. Called by its name, it would let the compiler drop the handler, and the exception would
  // reach the frames of the program above.
  void* (*volatile const load)(const char*, int) = &dlopen;
  try {
    load(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  } catch (...) {  // some versions of the C library let the exception pass
    std::_Exit(kThrew);
  }
  loaded.set();
  std::_Exit(0);
}

std::string fault_of(int status) {
  const bool killed = WIFSIGNALED(status);
  if (killed && WTERMSIG(status) == SIGXCPU) {
    return fmt::format(
        "its static objects take more than {} s of CPU time when it is loaded; a plugin should do its work when "
        "it is called",
        trial_time());
  }
  if (killed) return fmt::format("it crashes when it is loaded ({})", strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == kThrew) return "a static object of this plugin threw an exception when it was loaded";
  return fmt::format("a static object of this plugin ended the process when it was loaded (exit code {})", WEXITSTATUS(status));
}

}  // namespace

std::string load_trial(const std::string& path) {
  SharedFlag loaded;
  if (!loaded.made()) return "";
  const pid_t child = begin_child([&]() -> int { load_and_end(path, loaded); });
  if (child < 0) return "";
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return "";
  }
  return loaded.is_set() ? "" : fault_of(status);
}

}  // namespace gaitlab
