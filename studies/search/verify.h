// Verification of the best points with other steps and another engine.
#pragma once
#include "studies/search/trials.h"

namespace gaitlab::studies {

/// Runs each point again as the study's `verify` defines: with half the step, and in another engine with the default step of
/// that engine. A run verifies its point if it ends normally, is kept, and changes the objectives by at most `change`. In
/// addition, no verdict, including those of the original runs, may be `infeasible`, or `not judged` for lack of evidence. (In a
/// robust study, only the verdicts of the nominal runs count.)
///
/// A larger change of an objective does not reject a point if the study's step explains it: its limit of vanishing steps
/// (step_limit.h) differs from the value in the other engine by at most `change`. The point then has an entry `limit` with that
/// value.
///
/// A run in the other engine that does not verify its point, and in which steps were too long (check `step`, or it diverged),
/// is repeated with a quarter of the step. The repetition counts instead; its entry is `bullet at a quarter of its step`.
///
/// The result is ordered by point, then by kind of run; the first entry of a point describes its original runs (`as run`).
/// Returns nothing if `stop` was set.
std::optional<std::vector<Verification>> verify(const Plan& plan, Journal& journal, const Results& results,
                                                const std::vector<std::size_t>& points, const Executor& executor,
                                                const TrialsTold& told, std::atomic<bool>& stop);

/// Runs a point again once for each joint with a motor. This joint is dead from t = 0, so that the whole run is that of the
/// broken robot. The result has an entry for each joint, `m3/active dead`, which neither verifies nor rejects the point.
/// Returns nothing if `stop` was set.
std::optional<std::vector<Verification>> with_dead_joints(const Plan& plan, Journal& journal, const PointResult& point,
                                                          const Executor& executor, const TrialsTold& told,
                                                          std::atomic<bool>& stop);

}  // namespace gaitlab::studies
