// What the motors of a robot can do: the torque that is available at every speed, asked of the actuator, whichever it is.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/actuator.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// What the motors have at a speed: the actuator's effort at plus and minus its largest useful command.
class AvailableTorque {
 public:
  /// Throws PluginError.
  explicit AvailableTorque(const Scenario& scenario);
  /// There is one: something drives the joints.
  [[nodiscard]] const Actuator& actuator() const { return *actuator_; }
  /// Whether the actuator states a largest command for the joint; else what it has means nothing.
  [[nodiscard]] bool known(std::size_t joint) const { return joint < known_.size() && known_[joint]; }
  /// The largest commands; 0 where the actuator states no limit.
  [[nodiscard]] In commands() const { return most_; }
  /// N m of every joint, at its speed (rad/s): the most along its axis, and the least (so against it).
  void at(In speed, Out most, Out least) const;

 private:
  std::unique_ptr<Actuator> actuator_;
  std::vector<bool> known_;
  std::vector<double> most_, least_;
};

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
/// more, but at most three times it; without such a speed they reach to `fastest`. Of an actuator that throws nothing is known.
Motors motors(const Scenario& scenario, double fastest);

}  // namespace gaitlab::report
