// Trial load of a plugin's library in a child process.
#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace gaitlab {

/// Loads the library in a child process and calls `enter` with it, where static objects and registration may throw, crash, exit
/// or never return without an end of this process. Returns the reason of the child's end, such as "a static object of this
/// plugin threw an exception when it was loaded"; an empty text if dlopen and `enter` returned, also if they refused the file
/// by an exception of `enter`, or without a child. The child has 10 s of CPU time, and is killed if it sleeps without any for
/// `patience`. It ends with this process. Its output is dropped.
std::string load_trial(const std::string& path, const std::function<void(void* library)>& enter,
                       std::chrono::seconds patience = std::chrono::seconds(60));

}  // namespace gaitlab
