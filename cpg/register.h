// The CPGs and gaits built in.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab {
void register_cpgs(Registry& registry);
}
