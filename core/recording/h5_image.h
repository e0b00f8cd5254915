// The HDF5 part of trace.h5, as bytes. Only h5_image.cpp and h5_library.cpp use the HDF5 library.
#pragma once
#include <span>
#include <string_view>

#include "core/recording/stored_trace.h"

namespace gaitlab {

inline constexpr std::string_view kTraceFormat = "gaitlab-trace-1";
inline constexpr const char* kBeside[] = {"rest",  "ticks",  "loads",  "poses", "spread",
                                          "draws", "supply", "joints", "run"};  ///< tables of `/recording`
inline constexpr std::size_t kUserBlock = 512;  ///< bytes before the HDF5 part; the smallest number that HDF5 allows

/// Returns the file with an empty user block. Throws ImageError. Only one thread at a time uses HDF5; other threads wait.
SpilledVector<char> to_image(const Trace& trace, const Provenance& origin, std::span<const BesideOf> beside);

/// Reads the trace from the bytes of a whole file, including the user block. The HDF5 part must be a result of to_image. Throws
/// ImageError.
StoredTrace from_image(const SpilledVector<char>& file);

}  // namespace gaitlab
