#include "report/motors.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/laws/dc_motor.h"
#include "core/plugin/plugin_instance.h"
#include "core/plugin/robot_info.h"

namespace gaitlab::report {

std::vector<double> rest_torques(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return {};
  const std::unique_ptr<Actuator> actuator = make_actuator(scenario.actuator, info(*scenario.robot));
  const DcMotor* const motors = actuator->dc_motors();
  std::vector<double> torques;
  for (std::size_t j = 0; motors != nullptr && j < scenario.robot->joints.size(); ++j)
    torques.push_back(motors[j](motors[j].u_max, 0.0).torque);
  return torques;
}

AvailableTorque::AvailableTorque(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return;
  actuator_ = make_actuator(scenario.actuator, info(*scenario.robot));
  for (const double limit : actuator_->command_limit()) {
    most_.push_back(std::isfinite(limit) ? limit : 0);
    least_.push_back(-most_.back());
  }
}

bool AvailableTorque::known(std::size_t joint) const { return joint < most_.size() && most_[joint] > 0; }

void AvailableTorque::at(In speed, Out most, Out least) const {
  if (actuator_ == nullptr) return;
  std::vector<double> slope(speed.size());
  actuator_->effort(most_, speed, most, slope);
  actuator_->effort(least_, speed, least, slope);
}

bool limited(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return false;
  const std::unique_ptr<Actuator> actuator = make_actuator(scenario.actuator, info(*scenario.robot));
  return std::ranges::all_of(actuator->command_limit(), [](double limit) { return std::isfinite(limit); });
}

}  // namespace gaitlab::report
