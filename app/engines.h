// Engines that the program is built with: with Bullet (engines.cpp) or without (engines_without_bullet.cpp).
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab::app {

void register_engines(Catalog& catalog);

/// `Bullet 3.24 float64`, or `without Bullet`.
std::string bullet_text();

}  // namespace gaitlab::app
