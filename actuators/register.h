// The actuators built in.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab {
void register_actuators(Registry& registry);
}
