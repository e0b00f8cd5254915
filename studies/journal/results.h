// What a study found: its points in order, the best first.
#pragma once
#include <array>
#include <map>
#include <vector>

#include "studies/journal/journal.h"

namespace gaitlab::studies {

/// A point with all its replicates.
struct PointResult {
  std::uint64_t first_run = 0, runs = 0;
  std::uint64_t failed = 0;                              ///< of its runs
  Score score;                                           ///< of its replicates together
  double lived = 0;                                      ///< s simulated, of the replicate that failed first
  std::uint64_t feasible_runs = 0, infeasible_runs = 0;  ///< by the words of their verdicts
  [[nodiscard]] bool kept() const { return failed == 0 && score.kept(); }
  [[nodiscard]] bool feasible() const { return feasible_runs == runs; }
};

/// What failed, by outcome, with the first of each.
struct Failures {
  struct One {
    std::uint64_t count = 0, first_run = 0;
    std::string message;
  };
  std::map<std::string, One> by_outcome;
};

struct Results {
  std::vector<PointResult> points;  ///< in the order of runs; those of which a replicate is missing are left out
  Failures failures;
  std::uint64_t runs = 0, kept_runs = 0, feasible_runs = 0;
};

/// Of the runs of one point, in their order.
PointResult point_result(const JournalHead& head, std::span<const Brief> runs);

Results results(Journal& journal);

/// Runs whose torque error was estimated, and how many of these are beyond each share. Every run under an engine that has an
/// estimate has one where `estimate_every` is 1.
struct Estimated {
  static constexpr std::array kShares{0.01, 0.02, 0.05};
  std::uint64_t runs = 0;
  std::array<std::uint64_t, kShares.size()> beyond{};
  double worst = 0;
  /// Nine of ten are to be trusted (the last of the shares), or there is none to doubt.
  [[nodiscard]] bool trusted() const { return 10 * beyond.back() <= runs; }
};
Estimated estimated(Journal& journal);
/// The quantity that has it.
inline constexpr const char* kTorqueError = "torque_error.worst";

/// Kept points that no other is better than in all objectives, by the first objective, the best first. Of equal ones the
/// first.
std::vector<std::size_t> front(const std::vector<PointResult>& points, const std::vector<JournalObjective>& objectives);

/// A constraint or guard, and how many of the runs that came to their end break it.
struct BrokenLimit {
  std::string text;
  std::uint64_t runs = 0;
};
/// Those that any run breaks, the most often broken first.
std::vector<BrokenLimit> broken_limits(Journal& journal);

/// Kept ones by objective; then the others by violation; then failed by how long they lived, the longest first.
bool better(const PointResult& a, const PointResult& b, bool maximize);

/// Indices of points, the best first.
std::vector<std::size_t> ranked(const std::vector<PointResult>& points, bool maximize);

/// Replicates together: `worst` is the largest, `quantile` q the value that a share q of them does not exceed. Values are such
/// that more is worse.
double combined(std::vector<double> values, const std::string& how, double quantile);

}  // namespace gaitlab::studies
