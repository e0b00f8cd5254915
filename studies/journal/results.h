// Results of a study: its points in order, the best first.
#pragma once
#include <array>
#include <map>
#include <vector>

#include "studies/journal/journal.h"

namespace gaitlab::studies {

/// A point with all its replicates.
struct PointResult {
  std::uint64_t first_run = 0, runs = 0;
  std::uint64_t failed = 0;                              ///< number of failed runs
  Score score;                                           ///< over its replicates together
  double lived = 0;                                      ///< s simulated by the replicate that failed first
  std::uint64_t feasible_runs = 0, infeasible_runs = 0;  ///< by the words of their verdicts
  [[nodiscard]] bool kept() const { return failed == 0 && score.kept(); }
  [[nodiscard]] bool feasible() const { return feasible_runs == runs; }
};

/// Failed runs by outcome, with the first run of each.
struct Failures {
  struct One {
    std::uint64_t count = 0, first_run = 0;
    std::string message;
  };
  std::map<std::string, One> by_outcome;
};

struct Results {
  std::vector<PointResult> points;  ///< in the order of runs; points with missing replicates are left out
  Failures failures;
  std::uint64_t runs = 0, kept_runs = 0, feasible_runs = 0;
};

/// Result of the runs of one point, in their order.
PointResult point_result(const JournalHead& head, std::span<const Brief> runs);

Results results(Journal& journal);

/// Runs with an estimated torque error, and the number of these above each share. With `estimate_every` 1 every run has one, if
/// the engine offers an estimate.
struct Estimated {
  static constexpr std::array kShares{0.01, 0.02, 0.05};
  std::uint64_t runs = 0, others = 0;  ///< with and without an estimate
  std::array<std::uint64_t, kShares.size()> beyond{};
  double worst = 0;
  void add(double share);
  static constexpr std::uint64_t kFewest = 3;  ///< with fewer, the other runs are not trusted
  [[nodiscard]] bool too_few() const { return others > 0 && runs < kFewest; }
  /// At least nine of ten estimates are below the largest share, and there are enough of them.
  [[nodiscard]] bool trusted() const { return !too_few() && 10 * beyond.back() <= runs; }
};
Estimated estimated(Journal& journal);
/// Quantity with the estimate.
inline constexpr const char* kTorqueError = "torque_error.worst";

/// Kept points that no other point dominates, by the first objective, the best first. For equal points the first.
std::vector<std::size_t> front(const std::vector<PointResult>& points, const std::vector<JournalObjective>& objectives);

/// A constraint or guard, with the number of ended runs that break it.
struct BrokenLimit {
  std::string text;
  std::uint64_t runs = 0;
};
/// Limits that some run breaks, the most often broken first.
std::vector<BrokenLimit> broken_limits(Journal& journal);

/// Order of points: kept ones by objective; then the others by violation; then failed ones by simulated time, the longest
/// first.
bool better(const PointResult& a, const PointResult& b, bool maximize);

/// Indices of points, the best first.
std::vector<std::size_t> ranked(const std::vector<PointResult>& points, bool maximize);

/// Combines replicates: `worst` is the largest value, `quantile` q the value that a share q of them does not exceed. Larger
/// values are worse.
double combined(std::vector<double> values, const std::string& how, double quantile);

}  // namespace gaitlab::studies
