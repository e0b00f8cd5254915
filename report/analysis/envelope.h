// Torque-speed envelope of a robot's motors, computed from the actuator plugin.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/actuator.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Available torque of the motors at a speed: the actuator's effort at plus and minus its largest useful command.
class AvailableTorque {
 public:
  /// Throws PluginError.
  explicit AvailableTorque(const Scenario& scenario);
  /// The actuator; must exist: something drives the joints.
  [[nodiscard]] const Actuator& actuator() const { return *actuator_; }
  /// Whether the actuator states a largest command for the joint; otherwise its available torque has no meaning.
  [[nodiscard]] bool known(std::size_t joint) const { return joint < known_.size() && known_[joint]; }
  /// The largest commands; 0 without a stated limit.
  [[nodiscard]] In commands() const { return most_; }
  /// Torque limits of every joint at its speed (rad/s), N m: largest along its axis, and least (largest against it).
  void at(In speed, Out most, Out least) const;

 private:
  std::unique_ptr<Actuator> actuator_;
  std::vector<bool> known_;
  std::vector<double> most_, least_;
};

/// Envelope of one kind of motor. Empty and none: the actuator states no limit.
struct Envelope {
  std::string unit;                        ///< of the command: V, N m
  std::optional<double> command, current;  ///< largest useful command; A, if the current is limited
  std::optional<double> rest, no_load;     ///< N m at rest; rad/s without load
  std::vector<double> speed, most, least;  ///< rad/s; N m at the largest command along + and along -
  /// Ratings of the maker (DriveRatings): A RMS; N m, largest and RMS; rad/s.
  std::optional<double> continuous, gear_peak, gear_continuous, speed_max;
  bool operator==(const Envelope&) const = default;
};

struct Motors {
  std::vector<Envelope> kinds;
  std::vector<std::size_t> of_joint;  ///< index in kinds; empty: no joint has a motor
  [[nodiscard]] const Envelope& joint(std::size_t j) const { return kinds[of_joint[j]]; }
};

/// Envelopes of the motors. Speeds range from -w to w, with w a quarter above the speed without load, or `fastest` (rad/s, of
/// the run) if that is larger, but at most three times the former; without a speed without load w is `fastest`. Empty if the
/// actuator throws.
Motors motors(const Scenario& scenario, double fastest);

}  // namespace gaitlab::report
