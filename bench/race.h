// The runs: references, then every contender once a round, in an order that rotates.
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
  double least = 0.2;  ///< s; a point's shorter runs are repeated in a round until that has passed
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
  std::string note;    ///< why it does not count: refused, diverged, another walk than bullet's
  TorqueError error;   ///< against its own reference
  std::string worst_joint;
  std::optional<TorqueError> other;  ///< ours: against kOther
  Course course;
  std::vector<double> wall, cpu;  ///< s a run; one a round

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

/// What strays from the walk of reference kOther (strays(), bench/measure.h) does not count: a point has a note then, and a
/// reference is left out with all that are measured against it. Throws InputError: a scenario that no engine reads.
Results race(const RaceSettings& settings, Catalog& catalog);

}  // namespace gaitlab::versus
