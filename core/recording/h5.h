// Traces as HDF5: compressed, with units, definitions, the scenario they came from, and what else a recording holds.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/recording/trace.h"

namespace gaitlab {

/// Where a trace came from.
struct Provenance {
  std::string scenario;  ///< the resolved scenario, YAML
  std::int64_t seed = 0;
  std::string build;    ///< build id
  std::string outcome;  ///< `done`, or why the run ended early; empty in a file of format 1
  /// In recording.h5: hash() of the trace in the CSV file beside it.
  std::string csv_hash = {};
};

/// A table beside the trace: one of kBeside (recording_file.h says what each holds).
struct Beside {
  std::string name;
  Trace table;
};

/// The file could not be built, for want of memory: text that needs none may still be written.
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
/// format, size and hash_words() of the rest. No times: the same trace, the same bytes. The file appears whole or not at all;
/// it is built in memory (about twice its size on top of the trace). RunError: cannot be written (see AtomicFile); NoImage.
void write_h5(const Trace& trace, const Provenance& origin, const std::filesystem::path& path,
              std::span<const Beside> beside = {});

/// What write_h5 wrote, every bit of it, or a file of format gaitlab-trace-1 (the same without `/recording`, texts of variable
/// length). InputError `PATH: error: ...`, one message each: cannot be read, is empty, is not a gaitlab trace (foreign HDF5,
/// foreign file), has another format version, is truncated, is corrupt. A file that other tools
/// have changed counts as corrupt: HDF5 itself sees only bytes whose checksum is right, because it does not survive all others.
StoredTrace read_h5(const std::filesystem::path& path);

}  // namespace gaitlab
