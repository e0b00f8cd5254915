// Stopping a run by a signal of a user, a scheduler or a closed terminal.
#pragma once
#include <atomic>

namespace gaitlab::app {

/// True after the first SIGINT, SIGTERM or SIGHUP that follows the construction of a StopOnSignal. A signal that the process
/// already ignores remains ignored.
std::atomic<bool>& stopped();

struct StopOnSignal {
  enum class Second { is_ignored, ends_the_process };
  explicit StopOnSignal(Second second);
};

}  // namespace gaitlab::app
