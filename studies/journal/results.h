// Results of a study: its points, ordered from best to worst.
#pragma once
#include <array>
#include <map>
#include <vector>

#include "studies/journal/journal.h"

namespace gaitlab::studies {

/// A point with all its replicates.
struct PointResult {
  std::uint64_t first_run = 0, runs = 0;
  std::uint64_t failed = 0;                              ///< number of failed runs; 0 if `share` tolerates them
  Score score;                                           ///< objectives and violation, combined over the replicates
  double lived = 0;                                      ///< shortest simulated time of the failed replicates, s
  std::uint64_t feasible_runs = 0, infeasible_runs = 0;  ///< numbers of runs with verdict `feasible` and `infeasible`
  std::uint64_t stopped = 0;                             ///< number of stopped runs with a score
  [[nodiscard]] bool kept() const { return failed == 0 && score.kept(); }
  [[nodiscard]] bool feasible() const { return feasible_runs == runs; }
  [[nodiscard]] double feasible_share() const { return static_cast<double>(feasible_runs) / static_cast<double>(runs); }
};

/// Failed runs by outcome, with the number of the first such run.
struct Failures {
  struct One {
    std::uint64_t count = 0, first_run = 0;
    std::string message;
  };
  std::map<std::string, One> by_outcome;
};

struct Results {
  std::vector<PointResult> points;  ///< points in the order of their runs, without points that lack a replicate
  Failures failures;
  std::uint64_t runs = 0, kept_runs = 0, feasible_runs = 0;
};

/// Result of one point, from its runs in the order of their numbers.
PointResult point_result(const JournalHead& head, std::span<const Brief> runs);

Results results(Journal& journal);

/// Numbers of runs with and without an estimated torque error, and of estimates above 1 % and above the largest error with
/// which a run is judged. If `estimate_every` is 1, every run has an estimate, provided that the engine offers it.
struct Estimated {
  explicit Estimated(const JournalHead& head) : most(head.torque_error) {}
  static constexpr double kSmall = 0.01;
  double most;                         ///< largest torque error with which a run is judged
  std::uint64_t runs = 0, others = 0;  ///< number of runs with an estimate, and number of runs without
  std::uint64_t beyond_small = 0, beyond_most = 0;
  double worst = 0;
  void add(double share);
  /// Least number of estimates; with fewer estimates, no run without an estimate is trusted.
  static constexpr std::uint64_t kFewest = 3;
  [[nodiscard]] bool too_few() const { return others > 0 && runs < kFewest; }
  /// True if enough runs have an estimate and at most one in ten estimates exceeds `most`.
  [[nodiscard]] bool trusted() const { return !too_few() && 10 * beyond_most <= runs; }
};
Estimated estimated(Journal& journal);
/// Name of the quantity that contains the estimated torque error.
inline constexpr const char* kTorqueError = "torque_error.worst";

/// Indices of the kept points that no other point dominates, sorted by the first objective, best first. Of equal points only
/// the earliest is included.
std::vector<std::size_t> front(const std::vector<PointResult>& points, const std::vector<JournalObjective>& objectives);

/// A constraint or guard, with the number of ended runs that violate it.
struct BrokenLimit {
  std::string text;
  std::uint64_t runs = 0;
};
/// Limits that at least one run violates, sorted by decreasing number of such runs.
std::vector<BrokenLimit> broken_limits(Journal& journal);

/// True if point a precedes point b. Kept points come first, sorted by the first objective. Points that are not kept follow,
/// sorted by violation. Failed points come last, the longest simulated time first.
bool better(const PointResult& a, const PointResult& b, bool maximize);

/// Indices of points, sorted from best to worst.
std::vector<std::size_t> ranked(const std::vector<PointResult>& points, bool maximize);

/// Combines the values of the replicates, where a larger value is worse. `worst` is the largest value. `quantile` is the value
/// that a share `quantile` of the replicates does not exceed. `share` is the mean of the known values.
double combined(std::vector<double> values, const std::string& how, double quantile);

}  // namespace gaitlab::studies
