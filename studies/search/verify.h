// Whether the best points are gaits, or accidents of one step and one engine.
#pragma once
#include "studies/journal/results.h"
#include "studies/run/executor.h"

namespace gaitlab::studies {

/// The points to try: those that are kept, the best first, each further than 1 % of the box from those before it. Of a front
/// those that divide it evenly, its ends included.
std::vector<std::size_t> candidates(const Plan& plan, const Results& results);

/// Tries each again, as the study's `verify` says: with half the step, and in another engine with that one's step. It stands
/// where it comes to its end, is kept, its objectives change by at most `change`, and no verdict, that of the point's
/// own runs included, is `infeasible`, or `not judged` for want of evidence. By point, then by what was tried; the first of
/// each point is what its own runs were (`as run`). `told`: how many of the runs have ended, one call at a time. Nothing:
/// `stop` was set.
std::optional<std::vector<Verification>> verify(const Plan& plan, Journal& journal, const Results& results,
                                                const std::vector<std::size_t>& points, const Executor& executor,
                                                const std::function<void(std::size_t done, std::size_t of)>& told,
                                                std::atomic<bool>& stop);

/// Runs whose point stood in everything that was tried, in that order.
std::vector<std::uint64_t> verified(const std::vector<Verification>& tried);

}  // namespace gaitlab::studies
