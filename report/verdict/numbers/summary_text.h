// Texts of a run's summary: summary.json, terminal output, and warnings.
#pragma once
#include <string>

#include "report/analysis/summary.h"

namespace gaitlab::report {

/// The text of summary.json.
std::string to_json(const Summary& summary, const Scenario& scenario, const Recording& record);

/// Text that `gaitlab run --verbose` prints.
std::string to_text(const Summary& summary, const Scenario& scenario, const Recording& record);

/// Table of the joints in the judged window, one row per joint, the most loaded joint first.
std::string joint_table(const Summary& summary, const Scenario& scenario);

/// Warning that part of the robot starts below the ground; empty for other robots. This happens if the scenario states the
/// height, or if only contact elements touch the ground.
std::string start_warning(const Scenario& scenario);

}  // namespace gaitlab::report
