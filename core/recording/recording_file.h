// Files of a recording in its run folder.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/recording/h5.h"
#include "core/recording/recording.h"

namespace gaitlab {

inline constexpr const char* kBesideCsv = "recording.h5";  ///< data that trace.csv lacks

/// Writes trace.h5. If `format` is `csv`, writes trace.csv and, with the data that a CSV file cannot contain, recording.h5.
/// Tables of `/recording` are `rest`, `ticks`, `loads` and `poses` (see Recording), `joints` and `run`. A row of `joints` has
/// the statistics and the torque error of one joint. The only row of `run` has the numbers of the whole run. Throws RunError if
/// a file cannot be written. If there is too little memory for trace.h5, the rows go into trace.csv, which is written row by
/// row.
void write_recording(const Recording& recording, const Provenance& origin, const std::string& format,
                     const std::filesystem::path& folder);

/// A recording that was read from a run folder.
struct StoredRecording {
  std::filesystem::path file;    ///< trace.h5 or trace.csv
  std::filesystem::path tables;  ///< file of the scenario and of the other tables: recording.h5 beside trace.csv, else `file`
  Recording recording;
  Provenance origin;
  std::vector<std::string> missing;  ///< one sentence for each missing part of the folder; empty if it is complete
};

/// Reads the recording of a run folder. If there is only a CSV file, only a part of the recording is read. Throws InputError as
/// trace_file, read_h5 and read_csv, and if tables do not fit together.
StoredRecording read_recording(const std::filesystem::path& folder);

}  // namespace gaitlab
