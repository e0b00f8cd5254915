// The HDF5 part of trace.h5, in memory: the only user of the HDF5 library.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/trace/h5.h"

namespace gaitlab {

inline constexpr std::string_view kTraceFormat = "gaitlab-trace-1";
inline constexpr std::size_t kUserBlock = 512;  ///< bytes before the HDF5 part; the smallest that HDF5 knows

/// What the HDF5 library refused, or content that is not a trace.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What one writes and what origin; references, because a trace is big.
struct TraceView {
  const Trace& trace;
  const Origin& origin;
};

/// The bytes behind the user block. One thread at a time is in HDF5; others wait. Throws ImageError.
std::string to_image(const TraceView& stored);

/// From the whole file, user block included. Throws ImageError; the bytes must be those that to_image made.
StoredTrace from_image(const std::string& file);

}  // namespace gaitlab
