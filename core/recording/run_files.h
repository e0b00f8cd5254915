// A run read back from its folder.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/recording/trace.h"

namespace gaitlab {

/// Path of a run's trace: `run` itself if it is a file (.h5 or .csv), else trace.h5 or trace.csv in that folder, in this order.
/// Throws InputError if there is none, or it is a file of another kind.
std::filesystem::path trace_file(const std::filesystem::path& run);

/// Trace of that file. InputError: see trace_file, read_h5, read_csv.
Trace read_trace(const std::filesystem::path& run);

/// Object in summary.json of a run folder. Throws InputError if it is missing, not JSON (at FILE:LINE:COL), or not an object.
nlohmann::json read_summary(const std::filesystem::path& folder);

}  // namespace gaitlab
