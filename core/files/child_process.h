// Child processes, for work that may crash.
#pragma once
#include <sys/types.h>

#include <functional>

namespace gaitlab {

/// Forks a process that ends with the return value of `work` as its code, and does not outlive the thread that began it. It
/// inherits the three standard streams only; with other files a lock of a killed process would persist in its child. Exceptions
/// must not leave `work`. Returns -1, with the reason in errno, if no process can be created.
pid_t begin_child(const std::function<int()>& work);

}  // namespace gaitlab
