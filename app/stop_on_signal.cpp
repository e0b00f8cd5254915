#include "app/stop_on_signal.h"

#include <signal.h>

namespace gaitlab::app {

std::atomic<bool>& stopped() {
  static std::atomic<bool> flag{false};
  return flag;
}

StopOnSignal::StopOnSignal(Second second) {
  (void)stopped();  // creates the flag before a signal arrives
  struct sigaction action = {};
  action.sa_handler = [](int) { stopped() = true; };
  if (second == Second::ends_the_process) action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // a shell makes background jobs ignore SIGINT
  }
}

}  // namespace gaitlab::app
