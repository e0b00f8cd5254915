// Registration of the built-in controllers.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::controllers {
void register_controllers(Registry& registry);
}
