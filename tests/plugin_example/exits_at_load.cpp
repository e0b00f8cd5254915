// Plugin with a static object that ends the process while the library is loaded, as if all were well.
#include <cstdlib>

#include "core/plugin/plugin.h"

namespace {
struct Leaver {
  Leaver() { std::exit(0); }
};
const Leaver kLeaver;
}  // namespace

GAITLAB_PLUGIN(registry) { static_cast<void>(registry); }
