// Access of h5_image.cpp to the HDF5 library: lock, owners of identifiers, and memory for files.
#pragma once
#include <fmt/format.h>
#include <hdf5.h>

#include <mutex>
#include <utility>

#include "core/recording/h5_guard.h"
#include "core/recording/stored_trace.h"

namespace gaitlab {

using Image = SpilledVector<char>;  ///< bytes of an HDF5 file

/// Returns the result of an HDF5 function. Throws ImageError for a negative result, which means failure.
template <class Result>
Result checked(Result result, const char* what) {
  if (result < 0) throw ImageError(fmt::format("HDF5: {} failed", what));
  return result;
}

/// Throws std::bad_alloc if free memory is less than `more` bytes plus the memory that HDF5 needs beside a file and its values.
/// HDF5 1.10 crashes if one of its own allocations fails. Call this before calling HDF5, and before large allocations between
/// HDF5 calls.
void require_workspace(std::size_t more = 0);

/// Lock of the HDF5 library for one thread at a time, because Debian builds HDF5 without locks. Until the end of the lock,
/// HDF5 prints no messages on stderr and loads no filters. Both settings belong to the process, in which others may use HDF5.
class Library {
 public:
  Library() : lock_(mutex()) {
    require_workspace();
    // Must precede the first use of HDF5. Otherwise HDF5 complains at exit about objects left open after a damaged file.
    static const herr_t kNeverAtExit = h5_guard().enter == nullptr ? H5dont_atexit() : 0;
    static_cast<void>(kNeverAtExit);
    // A file names filters by number. An unknown number would make HDF5 load any library from a folder of the environment.
    H5PLget_loading_state(&loading_);
    H5PLset_loading_state(0);
    H5Eget_auto2(H5E_DEFAULT, &report_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Library() {
    H5Eset_auto2(H5E_DEFAULT, report_, data_);
    H5PLset_loading_state(loading_);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex only;
    return only;
  }
  /// The other user's lock, which is taken before the lock of this class.
  class Guarded {
   public:
    Guarded() : guard_(h5_guard()), entered_(guard_.enter == nullptr ? nullptr : guard_.enter()) {}
    ~Guarded() {
      if (guard_.leave != nullptr) guard_.leave(entered_);
    }
    Guarded(const Guarded&) = delete;
    Guarded& operator=(const Guarded&) = delete;

   private:
    H5Guard guard_;
    void* entered_;
  };

  Guarded guarded_;
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t report_ = nullptr;
  void* data_ = nullptr;
  unsigned loading_ = 0;
};

/// Owner of one HDF5 identifier. close() reports failures, which the destructor cannot do.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const char* what) : id_(checked(id, what)), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): replaces the identifier in calls
  void close(const char* what) { checked(close_(std::exchange(id_, -1)), what); }

 private:
  hid_t id_;
  Close close_;
};

/// Callbacks that make HDF5 write a file directly into `image`, which grows with the file. A second copy of a long trace would
/// not fit into memory. HDF5 uses `image` until the file is closed.
H5FD_file_image_callbacks_t memory_of(Image& image);

/// Callbacks that make HDF5 read a file from `image`, without copying or changing it.
H5FD_file_image_callbacks_t memory_in_place(const Image& image);

}  // namespace gaitlab
