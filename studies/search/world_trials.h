// Verification of points in worlds: robots, motors and grounds that differ from the scenario as real ones do.
#pragma once
#include "studies/search/trials.h"

namespace gaitlab::studies {

/// Runs the points that `tried` (verify.h) does not reject in the worlds of their scenarios (studies/plan/worlds.h), with the
/// first replicate in each scenario. A point stands in a world if all these runs end normally and break no constraint and no
/// guard, except that a margin required above 0 may be used up, and if no verdict is `infeasible`, or `not judged` for lack of
/// evidence; the objectives may change.
///
/// The result has the entries of `tried` and behind those of each point an entry for each world, `world supply -10 % (6.66 V)`,
/// whose reason is why the point falls there, and an entry `worlds`. Only the latter rejects the point, if its share is below
/// `verify.share`. Points are ordered by ranked_by_share(). Returns nothing if `stop` was set.
std::optional<std::vector<Verification>> in_worlds(const Plan& plan, Journal& journal, const Results& results,
                                                   const std::vector<Verification>& tried, const Executor& executor,
                                                   const TrialsTold& told, std::atomic<bool>& stop);
/// True for an entry of a single world.
bool is_world(const Verification& verification);

/// The worlds of a point, counted.
struct WorldCount {
  std::size_t stood = 0, of = 0;  ///< of 0: the point was not run in worlds
  std::size_t fell_drawn = 0, drawn = 0;
  std::vector<Verification> falls;  ///< entries of the worlds with one changed number in which the point falls
  [[nodiscard]] double share() const { return of == 0 ? 0 : static_cast<double>(stood) / static_cast<double>(of); }
};
WorldCount counted_worlds(const std::vector<Verification>& tried, std::uint64_t run);

/// Number of worlds that a share asks for.
std::size_t needed(double share, std::size_t of);

/// The entries ordered by point: points that nothing rejects are first, then those with the larger share of worlds, then those
/// with the better first objective, which is its limit of vanishing steps where one is known.
std::vector<Verification> ranked_by_share(const std::vector<Verification>& tried, bool maximize);

/// First runs of the points that no entry rejects, in the order of `tried`.
std::vector<std::uint64_t> verified(const std::vector<Verification>& tried);

}  // namespace gaitlab::studies
