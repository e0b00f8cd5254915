#include "app/shell/stop_on_signal.h"

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
  for (std::size_t k = 0; k < kSignals.size(); ++k) {
    sigaction(kSignals[k], nullptr, &before_[k]);
    if (before_[k].sa_handler != SIG_IGN)
      sigaction(kSignals[k], &action, nullptr);  // a shell makes background jobs ignore SIGINT
  }
}

StopOnSignal::~StopOnSignal() {
  for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], &before_[k], nullptr);
}

}  // namespace gaitlab::app
