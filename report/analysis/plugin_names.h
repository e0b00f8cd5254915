// Removal of folders from file paths in the texts of a result, which should not depend on where files are stored.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Returns `text` with every path of a plugin library and of a height file reduced to the file name.
std::string without_folders(std::string text, const Scenario& scenario);

}  // namespace gaitlab::report
