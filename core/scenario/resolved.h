// Resolved scenario, in which all settings are written out in full.
#pragma once
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Names of plugin libraries and of a file of heights in a resolved scenario. A text that leaves this process tells no folder:
/// names are those of files beside it. A text that this process reads again has the paths.
enum class FilePaths { names, whole };

/// Self-contained YAML text: every default is written out, module types and docks are inline, plugins are given by name and
/// hash, and more heights than kMostWritten by the name and hash of a file that a run folder contains. Reading and resolving
/// this text gives the same bytes.
std::string resolved(const Scenario& scenario, FilePaths paths = FilePaths::names);

}  // namespace gaitlab
