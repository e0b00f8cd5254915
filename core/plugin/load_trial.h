// Trial load of a plugin's library in a child process.
#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace gaitlab {

/// Limits of the child process.
struct TrialLimits {
  std::chrono::seconds cpu_time{10};  ///< or less, if this process has less
  std::chrono::seconds sleep{60};     ///< with hardly any CPU time
};

/// Loads the library in a child process and calls `enter` with it, where static objects and registration may throw, crash, exit
/// or never return without an end of this process. Returns the reason of the child's end, such as "a static object of this
/// plugin threw an exception when it was loaded"; an empty text if dlopen and `enter` returned, also if they refused the file
/// by an exception of `enter`, or without a child. The child ends with this process. Its output is dropped.
std::string load_trial(const std::string& path, const std::function<void(void* library)>& enter, TrialLimits limits = {});

}  // namespace gaitlab
