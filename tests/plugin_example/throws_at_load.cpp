// A plugin whose static object throws: before anything of gaitlab could look at it.
#include <stdexcept>

#include "core/plugin/plugin.h"

namespace {
struct Thrower {
  Thrower() { throw std::runtime_error("no luck"); }
};
const Thrower kThrower;
}  // namespace

GAITLAB_PLUGIN(registry) { static_cast<void>(registry); }
