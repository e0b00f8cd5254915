// A golden that strayed, as a page: the run of now over the golden one.
#pragma once
#include <string>

#include "golden/cases.h"

namespace gaitlab::app {

/// The page of a case whose golden and run were compared (docs/report.md). Both runs have the rows and columns of a golden, and
/// the robot of the scenario.
std::string failure_page(const golden::GoldenCase& c);

}  // namespace gaitlab::app
