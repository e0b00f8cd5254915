// Plausibility of a scenario and its module types: warnings on numbers outside the usual range, with the unit that would
// explain them.
#pragma once
#include "report/verdict/plausible/plausible_number.h"

namespace gaitlab::report {

/// All numbers whose plausibility is judged, in the order in which they are judged.
const std::vector<PlausibleNumber>& plausible_numbers();

/// Warnings on implausible numbers, and the rows that reported them, without the rows that the scenario accepts. Parts with one
/// mistake in one row share a warning.
struct Implausible {
  std::vector<Warning> warnings;
  std::vector<std::string> rows;
};
/// Throws PluginError.
Implausible implausible(const Scenario& scenario);

/// Numbers of a scenario that decide before any check of the verdict.
struct Doubts {
  /// Reason to judge no run of the scenario: an impossible number that is not accepted, and the remedy. Empty if there is none.
  std::string refused;
  std::string accepted;  ///< rows that the scenario accepts, each with its worst number; empty if it accepts none
};
/// Throws PluginError.
Doubts doubts(const Scenario& scenario);

/// Refuses rows in Scenario::accept without an unusual or impossible number (InputError). Throws PluginError.
void check_accepted(const Scenario& scenario);

}  // namespace gaitlab::report
