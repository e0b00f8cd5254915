// Names that keys of a scenario had in earlier editions.
#pragma once
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Gives them their present names, before and after the settings of --set. What --set gives under one name takes the place of
/// what the file gives under the other; two names by the same hand are a problem.
void rename_old_names(Node& root, const std::vector<std::string>& sets, Problems& problems);

}  // namespace gaitlab
