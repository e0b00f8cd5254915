// The definition of a study as text, and the description of the study in its journal.
#pragma once
#include <string>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Text of a study, equal for two studies with the same definition. The number of drawn points is not part of the text.
std::string definition(const BoundStudy& bound);

/// True if the definition is that of a study whose results another program gave.
bool told(const std::string& definition);

/// Names of the worlds of a robust study, one for each replicate from 1 on, from its definition. Empty for other studies.
std::vector<std::string> robust_worlds(const std::string& definition);

JournalHead journal_head(const Plan& plan);

}  // namespace gaitlab::studies
