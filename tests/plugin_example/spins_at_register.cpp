// Plugin whose gaitlab_register never returns: it computes or, if GAITLAB_PAUSES is set, sleeps and wakes ten times a second.
#include <unistd.h>

#include <atomic>
#include <cstdlib>

#include "core/plugin/plugin.h"

GAITLAB_PLUGIN(registry) {
  constexpr useconds_t kNap = 100'000;
  static_cast<void>(registry);
  for (std::atomic<int> turns = 0;; ++turns) {
    if (std::getenv("GAITLAB_PAUSES") != nullptr) ::usleep(kNap);
  }
}
