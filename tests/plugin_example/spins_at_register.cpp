// Plugin whose gaitlab_register never returns: it computes or, if GAITLAB_PAUSES is set, waits.
#include <unistd.h>

#include <atomic>
#include <cstdlib>

#include "core/plugin/plugin.h"

GAITLAB_PLUGIN(registry) {
  static_cast<void>(registry);
  for (std::atomic<int> turns = 0;; ++turns) {
    if (std::getenv("GAITLAB_PAUSES") != nullptr) ::pause();
  }
}
