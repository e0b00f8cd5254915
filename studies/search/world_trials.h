// Verification of points in worlds: robots, motors and grounds that differ from the scenario as real ones do.
#pragma once
#include "studies/search/trials.h"

namespace gaitlab::studies {

/// Runs the points that `tried` (verify.h) does not reject in the worlds of their scenarios (studies/plan/worlds.h), with the
/// first replicate in each scenario. A point stands in a world if all these runs end normally and break no constraint and no
/// guard, and no verdict is `infeasible`, or `not judged` for lack of evidence. If the study requires a margin above 0, a
/// margin of 0 suffices. The objectives may change.
///
/// The result contains the entries of `tried`. After those of each point follow an entry for each world, such as `world supply
/// -10 % (6.66 V)`, with the reason if the point falls there, and an entry `worlds`. Only the entry `worlds` can reject the
/// point. It does if the share of worlds where the point stands is below `verify.share`. Points are ordered by
/// ranked_by_share(). Returns nothing if `stop` was set.
std::optional<std::vector<Verification>> in_worlds(const Plan& plan, Journal& journal, const Results& results,
                                                   const std::vector<Verification>& tried, const Executor& executor,
                                                   const TrialsTold& told, std::atomic<bool>& stop);
/// True for an entry of a single world.
bool is_world(const Verification& verification);

/// Numbers of worlds in which a point stands and falls.
struct WorldCount {
  std::size_t stood = 0, of = 0;  ///< `of` is 0 if the point was not run in worlds
  std::size_t fell_drawn = 0, drawn = 0;
  std::vector<Verification> falls;  ///< entries of the worlds with one changed number in which the point falls
  [[nodiscard]] double share() const { return of == 0 ? 0 : static_cast<double>(stood) / static_cast<double>(of); }
};
WorldCount counted_worlds(const std::vector<Verification>& tried, std::uint64_t run);

/// Least number of worlds for a share.
std::size_t needed(double share, std::size_t of);

/// The entries sorted by point: points that no entry rejects first, then by larger share of worlds, then by better first
/// objective, or its limit of vanishing steps if known.
std::vector<Verification> ranked_by_share(const std::vector<Verification>& tried, bool maximize);

/// First runs of the points that no entry rejects, in the order of `tried`.
std::vector<std::uint64_t> verified(const std::vector<Verification>& tried);

}  // namespace gaitlab::studies
