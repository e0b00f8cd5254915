// Folder of the module types and robots that are shipped with the program.
#pragma once
#include <string>

namespace gaitlab {

/// Installation prefix: the nearest folder that contains `share/gaitlab/scenarios`, above the program or library with this
/// code. Empty if there is none. A build folder is a prefix, too: its `share` contains a link to the source tree.
std::string installation_prefix();

/// `share/gaitlab/scenarios` in the installation prefix. Without a prefix, the folder that the environment variable
/// GAITLAB_DATA names. Without this variable, the folder that an installation would use, for messages. Always a whole path.
std::string data_folder();

}  // namespace gaitlab
