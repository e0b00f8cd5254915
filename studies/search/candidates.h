// Candidates: the best points of a study that are worth a verification.
#pragma once
#include <vector>

#include "studies/journal/results.h"
#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Points to verify in a round, best first: up to `verify.best` kept points. Each differs from the others and from those in
/// `tried` by more than 10 % of the range in some coordinate. If there are too few, the best points that differ by more than 1
/// % follow. With several objectives there is only one round, of points that divide the front evenly, including its ends.
std::vector<std::size_t> candidates(const Plan& plan, const Results& results, const std::vector<std::size_t>& tried = {});

}  // namespace gaitlab::studies
