// Results of a sensitivity study: for the screen, as a table and as figures.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "studies/search/sensitivity.h"

namespace gaitlab::app {

/// A table per output, ordered by influence, with the parts that were left out; "" for other studies.
std::string sensitivity_text(studies::Journal& journal, const studies::Results& results);

/// Writes sensitivity.csv, and sensitivity-OUTPUT.svg for each; returns their names. `note`: description of the study, for the
/// figures. Empty for other studies.
std::vector<std::string> write_sensitivity(studies::Journal& journal, const studies::Results& results, const std::string& note,
                                           const std::filesystem::path& folder);

}  // namespace gaitlab::app
