// A recording in its run folder, written and read back.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/recording/h5.h"
#include "core/recording/recording.h"

namespace gaitlab {

inline constexpr const char* kBesideCsv = "recording.h5";  ///< what trace.csv does not hold

/// Writes trace.h5, or, for `format` csv, trace.csv and recording.h5, which has what the CSV file cannot hold. Tables of
/// `/recording`: `rest`, `ticks`, `loads` and `poses` (see Recording); `joints`, a row for each joint: its statistics and its
/// torque error; `run`, one row: what is known of the whole run. RunError: a file cannot be written; where memory was short, as
/// it may be for trace.h5, the rows are then in trace.csv, which is written row by row.
void write_recording(const Recording& recording, const Provenance& origin, const std::string& format,
                     const std::filesystem::path& folder);

/// A recording read back.
struct StoredRecording {
  Recording recording;
  Provenance origin;
  std::vector<std::string> missing;  ///< what the folder does not hold, a sentence each; none: everything is as it was written
};

/// Reads the recording of a run folder. A folder of an older format, or a CSV file alone, is read as far as it goes.
/// InputError: see trace_file, read_h5, read_csv; tables that do not fit together.
StoredRecording read_recording(const std::filesystem::path& folder);

}  // namespace gaitlab
