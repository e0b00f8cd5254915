// Candidates: the best points of a study that are worth a verification.
#pragma once
#include <vector>

#include "studies/journal/results.h"
#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Points to verify in a round, the best first: `verify.best` kept points that are not among `tried`. They are niches, 10 % of
/// the box apart from each other and from `tried` in some coordinate; if there are fewer, the best of the others that are 1 %
/// apart. With several objectives these are points that divide the front evenly, including its ends, and there is one round.
std::vector<std::size_t> candidates(const Plan& plan, const Results& results, const std::vector<std::size_t>& tried = {});

}  // namespace gaitlab::studies
