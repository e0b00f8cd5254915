// HDF5 files of traces: compressed, with units, definitions, the scenario, and the other tables of a recording.
#pragma once
#include <filesystem>
#include <span>

#include "core/errors.h"
#include "core/recording/stored_trace.h"

namespace gaitlab {

/// Error if there is too little memory for building the HDF5 file. Text files need little memory and can still be written.
class NoImage : public RunError {
 public:
  using RunError::RunError;
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
