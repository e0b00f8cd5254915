// HDF5 files of traces: compressed, with units, definitions, the scenario, and the other tables of a recording.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
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

/// Space that is reserved for a file, as a share of the bytes of its values. A walking robot's trace needs 0.41 to 0.56.
inline constexpr double kFileShare = 0.75;

/// A table to be written beside the trace.
struct BesideOf {
  const char* name;
  const Trace* table;
};

/// Error if there is too little memory for building the HDF5 file. Text files need little memory and can still be written.
class NoImage : public RunError {
 public:
  using RunError::RunError;
};

/// Contents of a trace file; a CSV file gives only the trace.
struct StoredTrace {
  std::filesystem::path file;
  Trace trace;
  Provenance origin;
  std::vector<Beside> beside;
};

/// Writes format gaitlab-trace-1. Dataset `/trace` is float64 [rows, columns] (MATLAB shows [columns, rows]), compressed
/// without loss (shuffle, gzip). Its attributes `columns`, `units`, `definitions` have one UTF-8 text per column, of fixed
/// length and padded with NULs. Each table of `beside` is stored in the same way as `/recording/NAME`. The root attributes are
/// `format`, `scenario`, `outcome`, `csv_hash`, `seed`, `build`, `rows`, `checksum` (hash() of the trace).
///
/// The first 512 bytes of the file, which HDF5 leaves to the user, contain format, size and hash_words() of the remaining
/// bytes. The file contains no dates, so that the same trace gives the same bytes. The file appears whole or not at all. It is
/// built in memory, or in a temporary file if it has more than 200 MB. Throws NoImage, and RunError if the file cannot be
/// written (see AtomicFile).
void write_h5(const Trace& trace, const Provenance& origin, const std::filesystem::path& path,
              std::span<const BesideOf> beside = {});

/// Reads a file of write_h5, bit for bit. Throws InputError `PATH: error: ...`, with one message for each of: cannot be read,
/// is empty, is not a gaitlab trace (foreign HDF5, foreign file), has another format version, is truncated, is corrupt. A file
/// that another program has changed counts as corrupt. HDF5 receives only bytes with the right checksum, because some damaged
/// files crash HDF5. Values are unpacked by unpack_chunks(), not by HDF5. An error in a dataset contains the name of the
/// dataset.
StoredTrace read_h5(const std::filesystem::path& path);

}  // namespace gaitlab
