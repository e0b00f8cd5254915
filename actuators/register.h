// Registration of the built-in actuators.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::actuators {
void register_actuators(Registry& registry);
}
