// Work that may take its process along is done in a process of its own.
#pragma once
#include <sys/types.h>

#include <functional>

namespace gaitlab {

/// Forks a process that ends with the code `work` returns, and does not outlive the thread that began it. It holds no file of
/// this process but the three standard streams: otherwise a lock of a killed process would live on in its child. Exceptions
/// must not leave `work`. -1, with the reason in errno: no process is to be had.
pid_t begin_child(const std::function<int()>& work);

}  // namespace gaitlab
