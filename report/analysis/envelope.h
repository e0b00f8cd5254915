// Torque-speed envelope of a robot's motors, computed from the actuator plugin.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/actuator.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Torque available from the motors at a speed: the actuator's effort under plus and minus its largest useful command.
class AvailableTorque {
 public:
  /// Throws PluginError.
  explicit AvailableTorque(const Scenario& scenario);
  /// The actuator plugin. Requires a scenario with an actuator.
  [[nodiscard]] const Actuator& actuator() const { return *actuator_; }
  /// True if the actuator states a largest command for the joint. Otherwise the available torque has no meaning.
  [[nodiscard]] bool known(std::size_t joint) const { return joint < known_.size() && known_[joint]; }
  /// Largest command of each joint; 0 if the actuator states none.
  [[nodiscard]] In commands() const { return most_; }
  /// Torque limits of every joint at its speed (rad/s), N m: the largest in the positive direction, and the least, which is the
  /// largest in the negative direction.
  void at(In speed, Out most, Out least) const;

 private:
  std::unique_ptr<Actuator> actuator_;
  std::vector<bool> known_;
  std::vector<double> most_, least_;
};

/// Torque-speed envelope of one kind of motor. The optional values and curves are empty if the actuator states no limit.
struct Envelope {
  std::string unit;                        ///< unit of the command: V or N m
  std::optional<double> command, current;  ///< largest useful command; largest current, A, if it is limited
  std::optional<double> rest, no_load;     ///< motor's torque at rest, N m; no-load speed of the joint, rad/s
  std::optional<double> holds;             ///< largest torque of the joint at rest, with friction and gear, N m
  /// Stall torque of a DC motor at its supply, N m: eta Kt n u_max / R, and at most the data sheet's. It does not depend
  /// on the model of the gear's efficiency.
  std::optional<double> stall;
  std::vector<double> speed, most, least;  ///< rad/s; N m at the largest positive and at the largest negative command
  /// Ratings of the maker (DriveRatings): RMS current, A; largest and RMS torque of the gear, N m; largest speed, rad/s.
  std::optional<double> continuous, gear_peak, gear_continuous, speed_max;
  bool operator==(const Envelope&) const = default;
};

struct Motors {
  std::vector<Envelope> kinds;
  std::vector<std::size_t> of_joint;  ///< index in `kinds` for each joint; empty if no joint has a motor
  [[nodiscard]] const Envelope& joint(std::size_t j) const { return kinds[of_joint[j]]; }
};

/// Envelopes of the motors. Speeds range from -w to w. w is the largest speed of the run, `fastest` (rad/s), but at least 1.25
/// and at most 3 times the no-load speed if there is one. If the actuator throws PluginError, all joints have an empty
/// envelope.
Motors motors(const Scenario& scenario, double fastest);

}  // namespace gaitlab::report
