// Finished and expected work of a remedy, for its progress.
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <mutex>

namespace gaitlab::report {

/// Runs of the search, and those that confirm its answers with the engine, step and estimate of the scenario.
enum class RemedyRuns : std::size_t { search, confirming };

class RemedyWork {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// Simulated time in s, by RemedyRuns.
  using Simulated = std::array<double, 2>;

  /// `ratio`: computing time of a simulated second in confirming runs / in the search, used until both are measured.
  explicit RemedyWork(double ratio) : ratio_(ratio) {}
  /// Begins runs of a kind. `to_come` is the expected time of these runs and of all after them.
  void begin(RemedyRuns kind, const Simulated& to_come, Time now);
  /// Counts a run that has ended. Returns the share of the work that is done. Several threads may call this at once.
  double ended(double simulated);
  /// Ends the runs that began last, and measures them.
  void end(Time now);

 private:
  RemedyRuns kind_ = RemedyRuns::search;
  double ratio_;
  Simulated done_{}, to_come_{}, wall_{};
  Time begun_;
  std::mutex mutex_;
};

}  // namespace gaitlab::report
