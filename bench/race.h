// A race of engines: reference runs, then every contender once per round, in a rotating order.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/contenders.h"
#include "bench/measure.h"

namespace gaitlab::versus {

struct RaceSettings {
  std::vector<std::string> scenarios;  ///< names of scenario files
  std::vector<std::string> sets;       ///< overrides of every scenario, key.path=value
  std::vector<std::string> only{"*"};  ///< patterns of the names of the contenders that take part
  double seconds = 8;                  ///< s, simulated time; errors are over its second half
  int rounds = 5;
  double least = 0.2;  ///< s of real time; within a round, a shorter run is repeated until this time has passed
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// A reference run of a scenario.
struct Converged {
  std::string scenario, name;
  double step = 0;  ///< s
  Torques torques;
  RaceTorqueError left;  ///< error of the run with the next longer step against this run
  Course course;
};

/// Results of a contender with one step.
struct RacePoint {
  std::string scenario, contender;
  ContenderGroup group = ContenderGroup::ours;
  double step = 0;  ///< s
  std::size_t lanes = 1;
  double seconds = 0;     ///< s, simulated time of a run, summed over the lanes
  std::string note;       ///< reason not to count the result: the step was refused, the run diverged, or the walk differs from
                          ///< bullet's
  RaceTorqueError error;  ///< against the reference of the engine
  std::string worst_joint;
  std::optional<RaceTorqueError> other;  ///< against kOther, for ContenderGroup::ours
  Course course;
  std::vector<double> wall, cpu;  ///< s per run; one value per round

  [[nodiscard]] bool ran() const { return note.empty() && !wall.empty(); }
  /// Simulated seconds per second of real time, the median over the rounds.
  [[nodiscard]] double speed() const { return seconds / median(wall); }
  [[nodiscard]] double slowest() const;
  [[nodiscard]] double fastest() const;
  [[nodiscard]] double cpu_speed() const { return seconds / median(cpu); }
};

struct RaceResults {
  std::vector<Converged> references;
  std::vector<RacePoint> points;
  std::vector<std::string> left_out;  ///< sentences on contenders and references that could not run

  /// Fastest result of `group` in `scenario` whose error of the worst joint is at most `error`; nullptr if there is none.
  [[nodiscard]] const RacePoint* fastest(const std::string& scenario, ContenderGroup group, double error) const;
};

/// Runs the race. A result whose walk differs from that of reference kOther (strays(), bench/measure.h) gets a note and does
/// not count. A reference whose walk differs is left out, with all contenders that are measured against it. Throws InputError
/// for a scenario that cannot be read.
RaceResults race(const RaceSettings& settings, Catalog& catalog);

}  // namespace gaitlab::versus
