// Names that keys of a scenario had in earlier versions.
#pragma once
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Renames keys with old names to their present names, before and after the settings of --set are applied. A value that --set
/// gives under either name replaces the value that the file gives under the other name. Both names in the same source are a
/// problem.
void rename_old_names(Node& root, const std::vector<std::string>& sets, Problems& problems);

}  // namespace gaitlab
