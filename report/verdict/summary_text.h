// The figures of a run as texts: summary.json, what the terminal shows, and warnings.
#pragma once
#include <string>

#include "report/analysis/summary.h"

namespace gaitlab::report {

/// The text of summary.json.
std::string to_json(const Summary& summary, const Scenario& scenario, const Recording& record);

/// The numbers that `gaitlab run --verbose` prints.
std::string to_text(const Summary& summary, const Scenario& scenario, const Recording& record);

/// A row per joint, the most loaded first: what each did in the judged window.
std::string joint_table(const Summary& summary, const Scenario& scenario);

/// The warning about a part of the robot that starts below the ground, or "": its height was given, or only contact elements
/// touch the ground.
std::string start_warning(const Scenario& scenario);

}  // namespace gaitlab::report
