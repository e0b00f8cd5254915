// What the motors of a robot have at rest, and who says so. At every speed: envelope.h.
#pragma once
#include <memory>
#include <vector>

#include "core/plugin/actuator.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Whether the drives are DC motors, which have a voltage and a current.
bool dc_motors(const Scenario& scenario);

/// N m, of every joint: the largest torque of its motor at rest, within its limits of voltage and current (eq. 1, 2); empty
/// where the actuator is not made of DC motors.
std::vector<double> rest_torques(const Scenario& scenario);

/// Who says what the motors have: the scenario, where it gives one of their settings, else the `source` that the module type
/// gives for its actuator; empty: nobody does.
std::string motor_source(const Scenario& scenario);

/// Whether a source says that its figures are chosen, not a maker's.
bool chosen(const std::string& source);

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

}  // namespace gaitlab::report
