// Runs of a race: references, then every contender once per round, in a rotating order.
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
  std::vector<std::string> scenarios;  ///< files
  std::string only = "*";              ///< pattern of the contenders' names
  double seconds = 8;                  ///< simulated; errors are of the second half
  int rounds = 5;
  double least = 0.2;  ///< s; shorter runs of a point are repeated within a round until this time has passed
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// A reference in a scenario.
struct Converged {
  std::string scenario, name;
  double step = 0;  ///< s
  Torques torques;
  TorqueError left;  ///< of the run before, with a longer step
  Course course;
};

/// A contender at one step.
struct Point {
  std::string scenario, contender;
  Group group = Group::ours;
  double step = 0;  ///< s
  std::size_t lanes = 1;
  double seconds = 0;  ///< simulated by a run, all lanes
  std::string note;    ///< reason not to count it: refused, diverged, another walk than bullet's
  TorqueError error;   ///< against the engine's reference
  std::string worst_joint;
  std::optional<TorqueError> other;  ///< for gaitlab's engines: against kOther
  Course course;
  std::vector<double> wall, cpu;  ///< s per run; one per round

  [[nodiscard]] bool ran() const { return note.empty() && !wall.empty(); }
  /// Simulated seconds per second.
  [[nodiscard]] double speed() const { return seconds / median(wall); }
  [[nodiscard]] double slowest() const;
  [[nodiscard]] double fastest() const;
  [[nodiscard]] double cpu_speed() const { return seconds / median(cpu); }
};

struct Results {
  std::vector<Converged> references;
  std::vector<Point> points;
  std::vector<std::string> left_out;  ///< sentences

  /// The fastest point of `group` in `scenario` whose worst error is at most `error`; nullptr: none.
  [[nodiscard]] const Point* fastest(const std::string& scenario, Group group, double error) const;
};

/// Runs the race. A point whose walk differs from that of reference kOther (strays(), bench/measure.h) gets a note and does not
/// count; such a reference is left out with all contenders measured against it. Throws InputError for a scenario that no engine
/// can read.
Results race(const RaceSettings& settings, Catalog& catalog);

}  // namespace gaitlab::versus
