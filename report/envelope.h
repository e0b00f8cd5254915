// What the motors of a robot can do: the torque that is available at every speed, asked of the actuator, whichever it is.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// One kind of motor. Empty and none: the actuator states no limit.
struct Envelope {
  std::string unit;                        ///< of the command: V, N m
  std::optional<double> command, current;  ///< largest useful command; A, where the current is what limits
  std::optional<double> rest, no_load;     ///< N m at rest; rad/s at which nothing is left
  std::vector<double> speed, most, least;  ///< rad/s; N m at the largest command along + and along -
  /// What the maker states (DriveRatings): A RMS; N m, largest and RMS; rad/s.
  std::optional<double> continuous, gear_peak, gear_continuous, speed_max;
  bool operator==(const Envelope&) const = default;
};

struct Motors {
  std::vector<Envelope> kinds;
  std::vector<std::size_t> of_joint;  ///< index in kinds; empty: nothing drives the joints
  [[nodiscard]] const Envelope& joint(std::size_t j) const { return kinds[of_joint[j]]; }
};

/// Speeds reach from -w to w, w a quarter more than the speed without load, or `fastest` (rad/s, of the run) where that is
/// more, but at most three times it; without such a speed they reach to `fastest`. Throws PluginError.
Motors motors(const Scenario& scenario, double fastest);

}  // namespace gaitlab::report
