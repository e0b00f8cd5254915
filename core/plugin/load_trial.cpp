#include "core/plugin/load_trial.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <utility>

#include "core/files/child_process.h"

namespace gaitlab {

namespace {

constexpr int kThrew = 3;                          // exit code of the child
constexpr rlim_t kTrialMemory = rlim_t{1} << 32U;  // bytes that a plugin may allocate; more than the tables of any plugin need

enum class Stage : char { loading, registering, done };

/// Stage that the child has reached. It cannot be the exit code, because the plugin may call exit().
class SharedStage {
 public:
  SharedStage() : page_(::mmap(nullptr, sizeof(char), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {}
  ~SharedStage() {
    if (made()) ::munmap(page_, sizeof(char));
  }
  SharedStage(const SharedStage&) = delete;
  SharedStage& operator=(const SharedStage&) = delete;

  [[nodiscard]] bool made() const { return page_ != MAP_FAILED; }
  void reach(Stage stage) { *static_cast<volatile Stage*>(page_) = stage; }
  [[nodiscard]] Stage reached() const { return *static_cast<volatile Stage*>(page_); }

 private:
  void* page_;
};

/// CPU time after which the child is killed, s.
rlim_t cpu_time_of(const TrialLimits& limits) {
  const auto allowed = static_cast<rlim_t>(limits.cpu_time.count());
  rlimit own{};
  return ::getrlimit(RLIMIT_CPU, &own) == 0 ? std::min(allowed, own.rlim_cur) : allowed;
}

/// Ends this process after this CPU time, s: by SIGXCPU or, if a static object ignores it, by SIGKILL later. The second limit
/// must be far above the first, because a virtual machine that is stopped for seconds counts them as CPU time.
void limit_time(rlim_t allowed) {
  constexpr rlim_t kIgnored = 10;  // s
  rlimit limit{};
  if (::getrlimit(RLIMIT_CPU, &limit) != 0) return;
  limit.rlim_cur = allowed;
  limit.rlim_max = std::min(allowed + kIgnored, limit.rlim_max);
  std::signal(SIGXCPU, SIG_DFL);
  (void)::setrlimit(RLIMIT_CPU, &limit);  // lowers the limits, which is always allowed
}

/// Limits the memory that this process may allocate in addition to its present data, which are terabytes under a sanitizer.
void limit_memory() {
  rlimit limit{};
  std::ifstream file("/proc/self/statm");
  rlim_t pages[6] = {};  // total, resident, shared, code, 0, data
  for (rlim_t& one : pages) file >> one;
  if (!file || ::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min(pages[5] * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kTrialMemory, limit.rlim_cur);
  (void)::setrlimit(RLIMIT_DATA, &limit);  // lowers the limit, which is always allowed
}

/// Loads the library, enters it and ends the process.
[[noreturn]] void load_and_end(const std::string& path, const std::function<void(void*)>& enter, rlim_t allowed,
                               SharedStage& stage) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  limit_time(allowed);
  limit_memory();
  std::set_terminate([] { std::_Exit(kThrew); });
  // dlopen is declared not to throw. If it were called by name, the compiler would drop the handler, and the exception would
  // reach the callers of this function.
  void* (*volatile const load)(const char*, int) = &dlopen;
  void* library = nullptr;
  try {
    library = load(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  } catch (...) {  // some versions of the C library let the exception through
    std::_Exit(kThrew);
  }
  stage.reach(Stage::registering);
  try {
    if (library != nullptr) enter(library);
  } catch (...) {  // NOLINT(bugprone-empty-catch): this process meets and reports it again
  }
  stage.reach(Stage::done);
  std::_Exit(0);
}

/// CPU time of a process, s; negative if it is not known.
double cpu_time(pid_t process) {
  clockid_t clock{};
  timespec used{};
  if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return -1;
  constexpr double kNano = 1e-9;
  return static_cast<double>(used.tv_sec) + kNano * static_cast<double>(used.tv_nsec);
}

/// True if a process waits for something other than processor or disk.
bool sleeps(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(file, line);
  const std::size_t name = line.rfind(") ");  // the name before `) ` may contain any character
  return name != std::string::npos && line.compare(name + 2, 1, "S") == 0;
}

/// Waits for the end of the child. If the child sleeps for the whole limit and uses hardly any CPU time, even if it wakes every
/// second, kills it and returns true.
bool falls_asleep(pid_t child, std::chrono::seconds patience) {
  constexpr std::chrono::milliseconds kLook{250};
  constexpr double kHardly = 0.1;  // s of CPU time
  const auto handle = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
  if (handle < 0) return false;  // the caller waits without a time limit
  std::chrono::milliseconds slept{0};
  double used = cpu_time(child);
  bool asleep = false;
  for (pollfd end{handle, POLLIN, 0}; !asleep && ::poll(&end, 1, static_cast<int>(kLook.count())) <= 0;) {
    if (const double now = cpu_time(child); now - used > kHardly) {
      used = now;
      slept = {};
    } else if (sleeps(child)) {
      slept += kLook;
    }
    asleep = slept > patience;
  }
  ::close(handle);
  if (asleep) ::kill(child, SIGKILL);
  return asleep;
}

std::string fault_of_entry(int status, rlim_t allowed) {
  constexpr const char* kEntry = "its gaitlab_register";
  const bool killed = WIFSIGNALED(status);
  if (killed && WTERMSIG(status) == SIGXCPU) {
    return fmt::format("{} takes more than {} s of CPU time; a plugin should do its work when it is called", kEntry, allowed);
  }
  if (killed) return fmt::format("{} crashes ({})", kEntry, strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == kThrew) return fmt::format("{} threw an exception out of a noexcept function", kEntry);
  return fmt::format("{} ended the process (exit code {})", kEntry, WEXITSTATUS(status));
}

std::string fault_of_load(int status, rlim_t allowed) {
  const bool killed = WIFSIGNALED(status);
  if (killed && WTERMSIG(status) == SIGXCPU) {
    return fmt::format(
        "its static objects take more than {} s of CPU time when it is loaded; a plugin should do its work when "
        "it is called",
        allowed);
  }
  if (killed) return fmt::format("it crashes when it is loaded ({})", strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == kThrew) return "a static object of this plugin threw an exception when it was loaded";
  return fmt::format("a static object of this plugin ended the process when it was loaded (exit code {})", WEXITSTATUS(status));
}

}  // namespace

std::string load_trial(const std::string& path, const std::function<void(void*)>& enter, TrialLimits limits) {
  const rlim_t allowed = cpu_time_of(limits);
  SharedStage stage;
  if (!stage.made()) return "";
  const pid_t child = begin_child([&]() -> int { load_and_end(path, enter, allowed, stage); });
  if (child < 0) return "";
  const bool asleep = falls_asleep(child, limits.sleep);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return "";
  }
  if (stage.reached() == Stage::done) return "";
  const bool loading = stage.reached() == Stage::loading;
  if (asleep) {
    return fmt::format("{} and used hardly any CPU time for {} s; a plugin should do its work when it is called",
                       loading ? "a static object slept when it was loaded" : "its gaitlab_register slept",
                       limits.sleep.count());
  }
  return loading ? fault_of_load(status, allowed) : fault_of_entry(status, allowed);
}

}  // namespace gaitlab
