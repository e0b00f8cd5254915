// Trial load of a plugin's library in a child process.
#pragma once
#include <string>

namespace gaitlab {

/// Loads the library in a child process, where its static objects may throw or crash without ending this process. Returns a
/// sentence on what ended the child, such as "a static object of this plugin threw an exception when it was loaded"; empty if
/// the child came to its end, also if dlopen refused the file. What static objects print in the child is dropped. Returns an
/// empty text, too, if no child can be made.
std::string load_trial(const std::string& path);

}  // namespace gaitlab
