// Registration of the built-in CPGs and gaits.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::cpg {
void register_cpgs(Registry& registry);
}
