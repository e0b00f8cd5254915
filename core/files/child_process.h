// Start of child processes for work that may crash.
#pragma once
#include <sys/types.h>

#include <functional>

namespace gaitlab {

/// Forks a process whose exit code is the return value of `work`. The process ends with the thread that began it. It inherits
/// only the three standard streams: if it inherited a locked file, the lock would persist after the parent is killed.
/// Exceptions must not leave `work`. Returns -1, with the reason in errno, if no process can be created.
pid_t begin_child(const std::function<int()>& work);

}  // namespace gaitlab
