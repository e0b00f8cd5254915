// Removal of folders from file paths in texts of a result: a folder is not part of a run.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// The text with every path of a plugin library, and of a file of heights, reduced to the file name.
std::string without_folders(std::string text, const Scenario& scenario);

}  // namespace gaitlab::report
