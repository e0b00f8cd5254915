// Resolved scenario, in which all settings are written out in full.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Self-contained YAML text: every default is written out, module types and docks are inline, and plugins are given by path and
/// hash. Reading and resolving this text gives the same bytes.
std::string resolved(const Scenario& scenario);

}  // namespace gaitlab
