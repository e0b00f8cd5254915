// Traces as HDF5: compressed, with units, definitions and the scenario they came from.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/trace/trace.h"

namespace gaitlab {

/// Where a trace came from.
struct Origin {
  std::string scenario;  ///< the resolved scenario, YAML
  std::int64_t seed = 0;
  std::string build;  ///< build id
};

struct StoredTrace {
  Trace trace;
  Origin origin;
};

/// Writes format gaitlab-trace-1. Dataset `/trace`: float64 [rows, columns] (MATLAB shows [columns, rows]), lossless (shuffle,
/// gzip), with attributes `columns`, `units`, `definitions`, one UTF-8 string a column; root attributes `format`, `scenario`,
/// `seed`, `build`, `rows`, `checksum` (hash() of the trace). The file's first 512 bytes, which HDF5 leaves to the user, hold
/// format, size and FNV-1a of the rest. No times: the same trace, the same bytes. The file appears whole or not at all; it is
/// built in memory (about twice its size on top of the trace). RunError: cannot be written (see AtomicFile).
void write_h5(const Trace& trace, const Origin& origin, const std::filesystem::path& path);

/// What write_h5 wrote, every bit of it. InputError `PATH: error: ...`, one message each: cannot be read, is empty, is no
/// gaitlab trace (foreign HDF5, foreign file), has another format version, is truncated, is corrupt. A file that other tools
/// have changed counts as corrupt: HDF5 itself sees only bytes whose checksum is right, because it does not survive all others.
StoredTrace read_h5(const std::filesystem::path& path);

}  // namespace gaitlab
