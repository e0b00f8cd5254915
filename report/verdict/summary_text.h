// Texts of a run's summary: summary.json, terminal output, and warnings.
#pragma once
#include <string>

#include "report/analysis/summary.h"

namespace gaitlab::report {

/// The text of summary.json.
std::string to_json(const Summary& summary, const Scenario& scenario, const Recording& record);

/// Output of `gaitlab run --verbose`.
std::string to_text(const Summary& summary, const Scenario& scenario, const Recording& record);

/// Table with a row per joint, the most loaded first: its statistics in the judged window.
std::string joint_table(const Summary& summary, const Scenario& scenario);

/// Warning about a part of the robot that starts below the ground, or "": possible if its height was given, or if only contact
/// elements touch the ground.
std::string start_warning(const Scenario& scenario);

}  // namespace gaitlab::report
