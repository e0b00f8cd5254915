// The definition of a study as text, and the description of the study in its journal.
#pragma once
#include <string>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Text of a study, equal for two studies with the same definition. The number of drawn points is not part of the text.
std::string definition(const BoundStudy& bound);

JournalHead journal_head(const Plan& plan);

}  // namespace gaitlab::studies
