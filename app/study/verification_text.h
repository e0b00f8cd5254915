// Text on the verification of the best points of a search.
#pragma once
#include <string>

#include "studies/journal/journal.h"

namespace gaitlab::app {

/// Text with the result of the verification of each best point, and the reasons if it failed. Empty if no point was verified.
/// A table of the winner with each joint dead in turn follows if `verify.faults` is each.
std::string verification_text(studies::Journal& journal);

}  // namespace gaitlab::app
