// Files that are shipped with the program, by kind and name.
#pragma once
#include <map>
#include <string>

namespace gaitlab {

/// Files that are shipped with the program, of `kind` module, robot, servo, cpg, scenario, study or recipe, as a map from name
/// to file.
std::map<std::string, std::string> shipped_files(const std::string& kind);

}  // namespace gaitlab
