// Traces as HDF5: compressed, with units, definitions, their scenario, and the other tables of a recording.
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
  std::string outcome;  ///< `done`, or the reason of an early end; empty in a file of format 1
  /// In recording.h5: hash() of the trace in the CSV file beside it.
  std::string csv_hash = {};
};

/// A table beside the trace: one of kBeside (contents: recording_file.h).
struct Beside {
  std::string name;
  Trace table;
};

/// The same, to be written.
struct BesideOf {
  const char* name;
  const Trace* table;
};

/// The file could not be built for lack of memory; text files, which need little, may still be written.
class NoImage : public RunError {
 public:
  using RunError::RunError;
};

struct StoredTrace {
  Trace trace;
  Provenance origin;
  std::vector<Beside> beside;  ///< none in a file of format 1
};

/// Writes format gaitlab-trace-2. Dataset `/trace`: float64 [rows, columns] (MATLAB shows [columns, rows]), lossless (shuffle,
/// gzip), with attributes `columns`, `units`, `definitions`, one UTF-8 text of fixed length for each column, filled up with
/// NULs; the same for each table of `beside` as `/recording/NAME`; root attributes `format`, `scenario`, `outcome`, `csv_hash`,
/// `seed`, `build`, `rows`, `checksum` (hash() of the trace). The file's first 512 bytes, which HDF5 leaves to the user, hold
/// format, size and hash_words() of the rest. It contains no dates: the same trace gives the same bytes. The file appears whole
/// or not at all; it is built in memory, or beyond 200 MB in a temporary file (SpilledVector). Throws RunError if it cannot be
/// written (see AtomicFile), and NoImage.
void write_h5(const Trace& trace, const Provenance& origin, const std::filesystem::path& path,
              std::span<const BesideOf> beside = {});

/// Reads a file of write_h5, bit for bit, or a file of format gaitlab-trace-1 (the same without `/recording`, texts of variable
/// length). Throws InputError `PATH: error: ...`, one message each: cannot be read, is empty, is not a gaitlab trace (foreign
/// HDF5, foreign file), has another format version, is truncated, is corrupt. A file that another program has changed counts as
/// corrupt: HDF5 is given only bytes with the right checksum, because some others crash it.
StoredTrace read_h5(const std::filesystem::path& path);

}  // namespace gaitlab
