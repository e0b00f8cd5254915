// Importance of the parameters of a study, as text for the terminal.
#pragma once
#include <string>

#include "studies/journal/results.h"

namespace gaitlab::app {

/// A table with the influence of each parameter and the range of the kept points, and sentences on ranges that are too wide or
/// too narrow. Empty for sensitivity studies, which print their indices, and for studies with few points.
std::string importance_text(studies::Journal& journal, const studies::Results& results);

}  // namespace gaitlab::app
