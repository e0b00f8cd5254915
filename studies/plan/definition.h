// The definition of a study as text, and the head of its journal.
#pragma once
#include <string>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Text that is equal for two studies of the same definition; it does not contain the number of drawn points.
std::string definition(const BoundStudy& bound);

JournalHead journal_head(const Plan& plan);

}  // namespace gaitlab::studies
