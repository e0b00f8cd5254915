// Verification of the best points with other steps and another engine.
#pragma once
#include "studies/journal/results.h"
#include "studies/run/executor.h"

namespace gaitlab::studies {

/// Points to verify: kept points, from the best on, at a distance above 1 % of the box from each other. With several objectives
/// these are points that divide the front evenly, including its ends.
std::vector<std::size_t> candidates(const Plan& plan, const Results& results);

/// Runs each point again as the study's `verify` defines: with half the step, and in another engine with the default step of
/// that engine. A run verifies its point if it ends normally, is kept, and changes the objectives by at most `change`. In
/// addition, no verdict, including those of the original runs, may be `infeasible`, or `not judged` for lack of evidence. The
/// result is ordered by point, then by kind of run; the first entry of a point describes its original runs (`as run`). `told`
/// is called with the number of ended runs; calls do not overlap. Returns nothing if `stop` was set.
std::optional<std::vector<Verification>> verify(const Plan& plan, Journal& journal, const Results& results,
                                                const std::vector<std::size_t>& points, const Executor& executor,
                                                const std::function<void(std::size_t done, std::size_t of)>& told,
                                                std::atomic<bool>& stop);

/// Runs a point again with each joint that has a motor dead in turn, from t = 0, so that the whole run is that of the broken
/// robot. The result has an entry for each joint, `m3/active dead`, which neither verifies nor rejects the point. Returns
/// nothing if `stop` was set.
std::optional<std::vector<Verification>> with_dead_joints(const Plan& plan, Journal& journal, const PointResult& point,
                                                          const Executor& executor,
                                                          const std::function<void(std::size_t done, std::size_t of)>& told,
                                                          std::atomic<bool>& stop);
/// True for an entry of with_dead_joints().
bool is_fault(const Verification& verification);

/// First runs of the points that passed every verification, in the order of `tried`.
std::vector<std::uint64_t> verified(const std::vector<Verification>& tried);

}  // namespace gaitlab::studies
