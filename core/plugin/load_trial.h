// Trial load of a plugin's library in a child process.
#pragma once
#include <string>

namespace gaitlab {

/// Loads the library in a child process, where its static objects may throw, crash, exit or run without end without an end of
/// this process. Returns the reason of the child's end, such as "a static object of this plugin threw an exception when it was
/// loaded"; an empty text if dlopen returned, also if it refused the file, or without a child. The child has 10 s of CPU time,
/// and ends with this process. Output of static objects in the child is dropped.
std::string load_trial(const std::string& path);

}  // namespace gaitlab
