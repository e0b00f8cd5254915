// Page of a run outside its golden's bands: the run over the golden.
#pragma once
#include <string>

#include "golden/cases.h"

namespace gaitlab::app {

/// The page of a case whose golden and run were compared (docs/report.md). Both runs have the rows and columns of a golden, and
/// the robot of the scenario.
std::string failure_page(const golden::GoldenCase& c);

}  // namespace gaitlab::app
