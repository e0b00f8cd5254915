// Stopping a run by a signal of a user, a scheduler or a closed terminal.
#pragma once
#include <signal.h>

#include <array>
#include <atomic>

namespace gaitlab::app {

/// True after the first SIGINT, SIGTERM or SIGHUP that follows the construction of a StopOnSignal. A signal that the process
/// already ignores remains ignored.
std::atomic<bool>& stopped();

/// Handlers of these signals. The destructor restores the previous handlers.
class StopOnSignal {
 public:
  enum class Second { is_ignored, ends_the_process };
  explicit StopOnSignal(Second second);
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_ = {};
};

}  // namespace gaitlab::app
