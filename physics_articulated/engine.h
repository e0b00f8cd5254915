// Registration of the engine `articulated`.
#pragma once
#include "core/plugin/catalog.h"

namespace gaitlab {

/// Registers the articulated-body algorithm of gaitlab with implicit integration (adaptive, implicit, extrapolated) and rk4.
void register_articulated(Catalog& catalog);

}  // namespace gaitlab
