// Results of a sensitivity study, as text for the terminal, as a CSV table and as figures.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "studies/search/sensitivity.h"

namespace gaitlab::app {

/// A table for each output with the parameters in order of influence, and the number of points that were left out. Empty for
/// other studies.
std::string sensitivity_text(studies::Journal& journal, const studies::Results& results);

/// Writes sensitivity.csv, and sensitivity-OUTPUT.svg for each output. Returns the names of the files; none for other studies.
/// `note` is a description of the study below the figures.
std::vector<std::string> write_sensitivity(studies::Journal& journal, const studies::Results& results, const std::string& note,
                                           const std::filesystem::path& folder);

}  // namespace gaitlab::app
