#include "core/files/child_process.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <climits>
#include <csignal>

namespace gaitlab {

pid_t begin_child(const std::function<int()>& work) {
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child != 0) return child;
  (void)::close_range(STDERR_FILENO + 1, UINT_MAX, 0);
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent ended before prctl took effect
  ::_exit(work());
}

}  // namespace gaitlab
