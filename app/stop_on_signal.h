// How a person, a scheduler or a closed terminal ends what runs.
#pragma once
#include <atomic>

namespace gaitlab::app {

/// Set by the first SIGINT, SIGTERM or SIGHUP after StopOnSignal was made; a signal that is ignored already stays so.
std::atomic<bool>& stopped();

struct StopOnSignal {
  enum class Second { is_ignored, ends_the_process };
  explicit StopOnSignal(Second second);
};

}  // namespace gaitlab::app
