// Plausibility of a scenario and its module types: warnings on numbers outside the usual range, with the unit that would
// explain them.
#pragma once
#include "report/verdict/plausible_number.h"
#include "report/verdict/warnings.h"

namespace gaitlab::report {

/// All plausible numbers, in the order in which they are judged.
const std::vector<PlausibleNumber>& plausible_numbers();

/// Warnings on implausible numbers, and the rows that reported them. Parts with one mistake in one row share a warning.
struct Implausible {
  std::vector<Warning> warnings;
  std::vector<std::string> rows;
};
/// Throws PluginError.
Implausible implausible(const Scenario& scenario);

}  // namespace gaitlab::report
