// Registration of the engine `bullet`.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// Explicit integration (semi_implicit, rk4) over btMultiBody's articulated-body algorithm with the penalty contact law.
void register_bullet(Catalog& catalog);

/// Version and precision of the library, for --version and the build id.
std::string bullet_version();

}  // namespace gaitlab
