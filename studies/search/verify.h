// Verification of the best points with other steps and another engine.
#pragma once
#include "studies/journal/results.h"
#include "studies/run/executor.h"

namespace gaitlab::studies {

/// Points to verify: kept ones, the best first, each at a distance above 1 % of the box from those before. For a front, points
/// that divide it evenly, its ends included.
std::vector<std::size_t> candidates(const Plan& plan, const Results& results);

/// Runs each point again, as the study's `verify` sets: with half the step, and in another engine with that one's step. It is
/// verified if it ends normally, is kept, its objectives change by at most `change`, and no verdict, including those of its
/// original runs, is `infeasible`, or `not judged` for lack of evidence. Ordered by point, then by kind of run; the first of
/// each point is its original runs (`as run`). `told`: called with the number of ended runs, one call at a time. Nothing:
/// `stop` was set.
std::optional<std::vector<Verification>> verify(const Plan& plan, Journal& journal, const Results& results,
                                                const std::vector<std::size_t>& points, const Executor& executor,
                                                const std::function<void(std::size_t done, std::size_t of)>& told,
                                                std::atomic<bool>& stop);

/// First runs of the points that passed every verification, in that order.
std::vector<std::uint64_t> verified(const std::vector<Verification>& tried);

}  // namespace gaitlab::studies
