// Lock of another user of HDF5 in the same process, for gaitlab as a library inside another program.
#pragma once

namespace gaitlab {

/// Functions that are called before the first and after the last call of HDF5 in each use of the library. `leave` gets the
/// result of `enter`.
struct H5Guard {
  void* (*enter)() = nullptr;
  void (*leave)(void* entered) = nullptr;
};

/// Sets the guard. To be called before the first use of HDF5. HDF5 with a guard also closes its files at exit, as the other
/// user expects.
void guard_h5(H5Guard guard) noexcept;
H5Guard h5_guard() noexcept;

}  // namespace gaitlab
