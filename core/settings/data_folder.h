// Folder of the module types and robots that are shipped with the program.
#pragma once
#include <string>

namespace gaitlab {

/// Installation prefix: the nearest folder above the file with this code, a program or a library, that contains
/// `share/gaitlab/scenarios`. Empty if there is none. A build folder is a prefix, too: its `share` contains a link to the
/// source tree.
std::string installation_prefix();

/// `share/gaitlab/scenarios` in the installation prefix. Without a prefix, the folder that the environment variable
/// GAITLAB_DATA names; without it, the folder in which an installation would have it, for messages. Always a whole path.
std::string data_folder();

}  // namespace gaitlab
