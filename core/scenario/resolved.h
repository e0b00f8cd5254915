// Resolved scenario: all settings written out in full.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// The self-contained YAML text: every default written out, module types and docks inlined, plugins by path and hash. Reading
/// and resolving it again gives the same bytes.
std::string resolved(const Scenario& scenario);

}  // namespace gaitlab
