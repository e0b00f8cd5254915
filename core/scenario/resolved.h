// Resolved scenario, in which all settings are written out in full.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Names of plugin libraries and of a file of heights in a resolved scenario. A text that leaves this process contains names of
/// files beside it, without their folders. A text that this process reads again contains whole paths.
enum class FilePaths { names, whole };

/// Self-contained YAML text: every default is written out, module types and docks are inline, and plugins are given by name and
/// hash. More heights than kMostWritten are given by name and hash of a file in the run folder. Reading and resolving this text
/// gives the same bytes.
std::string resolved(const Scenario& scenario, FilePaths paths = FilePaths::names);

}  // namespace gaitlab
