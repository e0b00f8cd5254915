// The controllers built in.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::controllers {
void register_controllers(Registry& registry);
}
