// Signals with which a user, a scheduler or a closed terminal stops a run.
#pragma once
#include <atomic>

namespace gaitlab::app {

/// Set by the first SIGINT, SIGTERM or SIGHUP after StopOnSignal was made; an ignored signal remains ignored.
std::atomic<bool>& stopped();

struct StopOnSignal {
  enum class Second { is_ignored, ends_the_process };
  explicit StopOnSignal(Second second);
};

}  // namespace gaitlab::app
