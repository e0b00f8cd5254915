// Trial load of a plugin's library in a child process.
#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace gaitlab {

/// Limits of the child process.
struct TrialLimits {
  std::chrono::seconds cpu_time{10};  ///< less if the limit of this process is lower
  std::chrono::seconds sleep{60};     ///< time that the process may sleep with hardly any CPU time
};

/// Loads the library in a child process and calls `enter` with it, so that this process survives static objects and a
/// registration that throw, crash, exit or never return. Returns the reason for the end of the child, such as "a static object
/// of this plugin threw an exception when it was loaded". Returns an empty text if dlopen and `enter` returned or refused the
/// file, or if no child could be created. The child ends with this process. Its output is dropped.
std::string load_trial(const std::string& path, const std::function<void(void* library)>& enter, TrialLimits limits = {});

}  // namespace gaitlab
