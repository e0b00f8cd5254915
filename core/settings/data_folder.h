// Where the module types and robots that come with the program are.
#pragma once
#include <string>

namespace gaitlab {

/// `../share/gaitlab/scenarios` beside the program's folder where it is installed, else the source tree's scenarios.
std::string data_folder();

}  // namespace gaitlab
