// Plugin with a static object that never returns. If GAITLAB_PAUSES is set, it writes the number of its process to that file
// and waits; otherwise it computes.
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>

#include "core/plugin/plugin.h"

namespace {
struct Spinner {
  Spinner() {
    const char* file = std::getenv("GAITLAB_PAUSES");
    if (file != nullptr) std::ofstream(file) << ::getpid() << std::endl;
    for (std::atomic<int> turns = 0;; ++turns) {
      if (file != nullptr) ::pause();
    }
  }
};
const Spinner kSpinner;
}  // namespace

GAITLAB_PLUGIN(registry) { static_cast<void>(registry); }
