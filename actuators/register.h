// The actuators built in.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::actuators {
void register_actuators(Registry& registry);
}
