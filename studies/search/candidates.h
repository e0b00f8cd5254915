// Candidates: the best points of a study that are worth a verification.
#pragma once
#include <vector>

#include "studies/journal/results.h"
#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Points to verify: kept points, the best first. They are niches, 10 % of the box apart in some coordinate; if there are fewer
/// than `verify.best`, the best of the others that are 1 % apart. With several objectives these are points that divide the
/// front evenly, including its ends.
std::vector<std::size_t> candidates(const Plan& plan, const Results& results);

}  // namespace gaitlab::studies
