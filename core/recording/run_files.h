// Reader of the files of a run folder.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/recording/h5.h"

namespace gaitlab {

/// Path of the trace of a run: `run` itself if it is a file (.h5 or .csv), else trace.h5 or trace.csv in the folder `run`, in
/// this order. Throws InputError if the file does not exist, or `run` is a file of another kind.
std::filesystem::path trace_file(const std::filesystem::path& run);

/// Reads the trace of a run. Throws InputError as trace_file, read_h5 and read_csv.
StoredTrace read_trace(const std::filesystem::path& run);

/// Reads the object in summary.json of a run folder. Throws InputError if the file is missing, not JSON (at FILE:LINE:COL), or
/// not an object.
nlohmann::json read_summary(const std::filesystem::path& folder);

}  // namespace gaitlab
