// Registration of the engine `bullet`.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// Registers the engine: the articulated-body algorithm of btMultiBody, with the implicit integrators of
/// engine articulated or explicit ones (semi_implicit, rk4) and the penalty contact law, or with the solver of Bullet
/// (contact.law: bullet).
void register_bullet(Catalog& catalog);

/// Version and precision of the Bullet library, for --version and the build id.
std::string bullet_version();

}  // namespace gaitlab
