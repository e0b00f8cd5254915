// The CPGs and gaits built in.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::cpg {
void register_cpgs(Registry& registry);
}
