// Plugin with a static object that throws while the library is loaded, before gaitlab can check the plugin.
#include <stdexcept>

#include "core/plugin/plugin.h"

namespace {
struct Thrower {
  Thrower() { throw std::runtime_error("no luck"); }
};
const Thrower kThrower;
}  // namespace

GAITLAB_PLUGIN(registry) { static_cast<void>(registry); }
