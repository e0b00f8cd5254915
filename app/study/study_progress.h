// Progress of studies, on a line of stderr.
#pragma once
#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "app/shell/progress.h"
#include "studies/run/runner.h"
#include "studies/search/optimizer.h"

namespace gaitlab::app {

/// Progress of a study.
class StudyProgress {
 public:
  StudyProgress(bool quiet, std::string unit) : line_(quiet), unit_(std::move(unit)) {}
  void operator()(const studies::Standing& standing);
  /// Called before each generation of a search.
  void operator()(const studies::SearchPlace& place);

 private:
  using Time = TimeLeft::Time;
  /// Rate in runs per s over the last minute. 0 if not known yet.
  double rate(Time now, std::uint64_t ended);

  ProgressLine line_;
  TimeLeft left_{std::chrono::steady_clock::now()};
  std::string unit_, place_;
  std::deque<std::pair<Time, std::uint64_t>> minute_;  ///< number of completed runs at these times
};

/// Progress of a known number of runs. Calls from several threads at once are allowed. Copies continue the same line, because
/// functions that execute runs take their progress by value.
class AgainProgress {
 public:
  /// `what` states the purpose of the runs, as in `verification`.
  AgainProgress(bool quiet, std::string what);
  /// With `done` 0 a line states the purpose and the number of the runs.
  void operator()(std::size_t done, std::size_t of);
  /// Counts further runs that have ended.
  void add(std::size_t runs, std::size_t of);

 private:
  struct Line;
  void show(std::size_t done, std::size_t of);

  std::shared_ptr<Line> line_;
  std::string what_;
};

}  // namespace gaitlab::app
