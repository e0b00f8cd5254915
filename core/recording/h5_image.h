// The HDF5 part of trace.h5, in memory: only this file uses the HDF5 library.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/recording/h5.h"

namespace gaitlab {

inline constexpr std::string_view kTraceFormats[] = {"gaitlab-trace-1", "gaitlab-trace-2"};  ///< the last one is written
inline constexpr const char* kBeside[] = {"rest",   "ticks",  "loads", "poses",
                                          "spread", "joints", "run"};  ///< tables of `/recording`
inline constexpr std::size_t kUserBlock = 512;  ///< bytes before the HDF5 part; the smallest that HDF5 allows

/// Failure of the HDF5 library, or content that is not a trace.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes after the user block. One thread at a time uses HDF5; others wait. Throws ImageError.
SpilledVector<char> to_image(const Trace& trace, const Provenance& origin, std::span<const BesideOf> beside);

/// Trace from a whole file, user block included. Throws ImageError; the bytes must be those of to_image.
StoredTrace from_image(const std::string& file);

}  // namespace gaitlab
