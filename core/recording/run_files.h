// A run read back from its folder.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/recording/trace.h"

namespace gaitlab {

/// The trace of a run: `run` itself where it is a file (.h5 or .csv), else trace.h5 or trace.csv in that folder, in this order.
/// InputError: there is none; a file of another kind.
std::filesystem::path trace_file(const std::filesystem::path& run);

/// That file, read. InputError: see trace_file, read_h5, read_csv.
Trace read_trace(const std::filesystem::path& run);

/// summary.json of a run folder, an object. InputError: missing; not JSON (at FILE:LINE:COL); no object.
nlohmann::json read_summary(const std::filesystem::path& folder);

}  // namespace gaitlab
