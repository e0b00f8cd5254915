// Contents of a trace file, and the error for a file with other contents.
#pragma once
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/recording/trace.h"

namespace gaitlab {

/// Origin of a trace.
struct Provenance {
  std::string scenario;  ///< the resolved scenario, YAML
  std::int64_t seed = 0;
  std::string build;    ///< build id
  std::string outcome;  ///< `done`, or the reason of an early end
  /// hash() of the trace in the CSV file of the same folder. Used in recording.h5 only.
  std::string csv_hash = {};
};

/// A table stored in addition to the trace. Its name is one of kBeside; recording_file.h describes the contents.
struct Beside {
  std::string name;
  Trace table;
};

/// A table to be written beside the trace.
struct BesideOf {
  const char* name;
  const Trace* table;
};

/// Contents of a trace file; a CSV file gives only the trace.
struct StoredTrace {
  std::filesystem::path file;
  Trace trace;
  Provenance origin;
  std::vector<Beside> beside;
};

/// Space that is reserved for a file, as a share of the bytes of its values. A walking robot's trace needs 0.41 to 0.56.
inline constexpr double kFileShare = 0.75;

/// Failure of the HDF5 library, or content that is not a trace.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gaitlab
