// Registration of the built-in sensors.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::sensors {

void register_sensors(Registry& registry);

}  // namespace gaitlab::sensors
