// Text and JSON of a remedy, for the terminal, the page and remedy.json.
#pragma once
#include <string>
#include <vector>

#include "report/remedy/remedy.h"
#include "report/verdict/screen.h"

namespace gaitlab::report {

/// Lines for the terminal. An infeasible run has lines such as `feasible with i_max >= 0.719 A (now 0.408 A): 0.0263 m/s`, and
/// the settings that do not help. A feasible run has lines such as `stays feasible with frequency up to 0.34 Hz`.
std::vector<ScreenLine> remedy_lines(const Remedy& remedy);

/// The text of remedy.json.
std::string to_json(const Remedy& remedy);

/// The members of a remedy.json that the page shows, as JSON text. Empty if the text is not a remedy of the run with this
/// resolved scenario and verdict, or has members of other types.
std::string shown_remedy(const std::string& text, const std::string& scenario_hash, Word word);

}  // namespace gaitlab::report
