// Plugin whose gaitlab_register ends the process, as if all were well.
#include <cstdlib>

#include "core/plugin/plugin.h"

GAITLAB_PLUGIN(registry) {
  static_cast<void>(registry);
  std::exit(0);
}
