// Trial load of a plugin's library in a child process.
#pragma once
#include <string>

namespace gaitlab {

/// Loads the library in a child process, where its static objects may throw or crash without an end of this process. Returns
/// the reason of the child's end, such as "a static object of this plugin threw an exception when it was loaded"; an empty text
/// if the child came to its end, if dlopen refused the file, or without a child. Output of static objects in the child is
/// dropped.
std::string load_trial(const std::string& path);

}  // namespace gaitlab
