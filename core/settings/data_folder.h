// Folder of the module types and robots that are shipped with the program.
#pragma once
#include <string>

namespace gaitlab {

/// Path `../share/gaitlab/scenarios` relative to the program's folder if the program is installed, otherwise the scenarios of
/// the source tree.
std::string data_folder();

}  // namespace gaitlab
