// Folder of the module types and robots that are shipped with the program.
#pragma once
#include <string>

namespace gaitlab {

/// `../share/gaitlab/scenarios` beside the program's folder if it is installed, else the source tree's scenarios.
std::string data_folder();

}  // namespace gaitlab
