// What the motors of a robot have, whichever actuator holds them.
#pragma once
#include <memory>
#include <vector>

#include "core/plugin/actuator.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// N m, of every joint: the largest torque of its motor at rest, within its limits of voltage and current (eq. 1, 2); empty
/// where the actuator is not made of DC motors.
std::vector<double> rest_torques(const Scenario& scenario);

/// What the motors have at a speed, asked of the actuator: its effort at plus and minus its largest useful command.
class AvailableTorque {
 public:
  explicit AvailableTorque(const Scenario& scenario);
  /// Whether the actuator states a largest command for the joint; else nothing is known of it.
  [[nodiscard]] bool known(std::size_t joint) const;
  /// N m of every joint, at its speed (rad/s): the most along its axis, and the least (so against it).
  void at(In speed, Out most, Out least) const;

 private:
  std::unique_ptr<Actuator> actuator_;
  std::vector<double> most_, least_;  // commands; 0 where there is no limit
};

/// Whether every joint's actuator states a largest command, and so a limit that can be reached.
bool limited(const Scenario& scenario);

}  // namespace gaitlab::report
