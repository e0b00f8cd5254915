// Registration of the engine `articulated`.
#pragma once
#include "core/plugin/catalog.h"

namespace gaitlab {

/// Our own articulated-body algorithm with implicit integration (adaptive, implicit, extrapolated) and rk4.
void register_articulated(Catalog& catalog);

}  // namespace gaitlab
