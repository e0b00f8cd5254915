// HTML page of a run that left the bands of its golden; it draws the run over the golden.
#pragma once
#include <string>

#include "golden/cases.h"

namespace gaitlab::app {

/// HTML text of the page for a case whose golden and run were compared (docs/report.md). Run and golden have the rows and
/// columns of the golden, and the robot of the scenario.
std::string failure_page(const golden::GoldenCase& c);

}  // namespace gaitlab::app
