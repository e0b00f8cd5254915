// Catalog of the program: engines, actuators, controllers, sensors, CPGs and plugin libraries.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"

namespace gaitlab::kit {

/// Catalog of all built-in engines, actuators, controllers, sensors and CPGs, and of the given plugin libraries.
Catalog standard_catalog(const std::vector<std::string>& plugins = {});

}  // namespace gaitlab::kit
