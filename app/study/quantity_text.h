// Names and units of the quantities of a study, for its texts and files.
#pragma once
#include <string>

#include "studies/journal/journal.h"

namespace gaitlab::app {

/// First objective with its unit, if it is a single quantity: `speed, m/s`.
std::string objective_text(const studies::JournalHead& head);
/// Unit of the first objective after a space: ` m/s`. Empty without a unit.
std::string objective_unit(const studies::JournalHead& head);

/// Name of a quantity as a file name: characters other than letters, digits, `.`, `_` and `-` become `-`.
std::string file_name(const std::string& quantity);

}  // namespace gaitlab::app
