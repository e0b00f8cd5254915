// figure.svg of a run: the most loaded joint on twin axes, and the robot from the side at the last five seconds.
#pragma once
#include <string>

#include "report/summary.h"

namespace gaitlab {
std::string run_figure(const Scenario& scenario, const RunRecord& record, const Summary& summary);
}  // namespace gaitlab
