// Engines that the program is built with; engines.cpp includes Bullet, engines_without_bullet.cpp omits it.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab::kit {

void register_engines(Catalog& catalog);

/// Text `Bullet 3.24 float64`, or `without Bullet`.
std::string bullet_text();

}  // namespace gaitlab::kit
