// What a sensitivity study found, for the screen, as a table and as figures.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "studies/search/sensitivity.h"

namespace gaitlab::app {

/// A table per output, what matters most first, with what was left out; "" of other studies.
std::string sensitivity_text(studies::Journal& journal, const studies::Results& results);

/// sensitivity.csv, and sensitivity-OUTPUT.svg for each; their names. `note`: what study it is, for the figures. None of other
/// studies.
std::vector<std::string> write_sensitivity(studies::Journal& journal, const studies::Results& results, const std::string& note,
                                           const std::filesystem::path& folder);

}  // namespace gaitlab::app
