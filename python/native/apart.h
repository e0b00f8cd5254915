// Work without the interpreter's lock, in a thread of its own.
#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace gaitlab::python {

/// Does `work` in a thread of its own, without the interpreter's lock and in the floating-point environment that a program
/// starts with, because some Python packages make the processor flush subnormal numbers to zero. To be called with the lock
/// held. The calling thread checks for Ctrl-C about twenty times a second and calls `told`, which may be empty, with the lock
/// held. If either raises an exception, `stop` is set and the exception is thrown when the work has ended; otherwise an
/// exception of the work is thrown. At the end of the interpreter `stop` is set, and the call does not return.
void apart(std::atomic<bool>& stop, const std::function<void()>& told, const std::function<void()>& work);
/// The same for work that cannot be stopped.
void apart(const std::function<void()>& work);

/// Makes the works of daemon threads end before the interpreter ends.
void end_with_interpreter();

/// From now on, collects the texts that the program would print on stderr.
void gather_said();
/// Texts since the last call, each without the end of its line.
std::vector<std::string> take_said();

/// From now on, holds the interpreter's lock, and that of h5py if it is imported, around each use of HDF5.
void share_h5();

}  // namespace gaitlab::python
