#include "golden/natural_scales.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>

#include "core/laws/dc_motor.h"
#include "core/model/extent.h"
#include "core/plugin/actuator.h"
#include "core/scenario/built_robot.h"
#include "core/simulation/start.h"

namespace gaitlab::golden {

namespace {

/// Largest effort of a joint's motor at rest; all 0 without a DC motor.
struct Motor {
  double torque = 0, current = 0, voltage = 0;  ///< N m, A, V
};

std::vector<Motor> motors_of(const Scenario& scenario) {
  std::vector<Motor> found(scenario.robot->joints.size());
  if (scenario.actuator.entry == nullptr) return found;
  const std::unique_ptr<Actuator> actuator = make_motors(scenario);
  const DcMotor* const motors = actuator->dc_motors();
  for (std::size_t j = 0; motors != nullptr && j < found.size(); ++j) {
    if (!scenario.robot->joints[j].driven()) continue;
    const DcMotor::Effort rest = motors[j](motors[j].u_max, 0.0);
    found[j] = {rest.torque, rest.current, motors[j].u_max};
  }
  return found;
}

double largest(const std::vector<Motor>& motors, double Motor::*quantity) {
  double most = 0;
  for (const Motor& motor : motors) most = std::max(most, motor.*quantity);
  return most;
}

/// Number of the joint of a column `joint.J.NAME`, or the number of joints.
std::size_t joint_of(std::string_view column, std::size_t joints) {
  constexpr std::string_view kHead = "joint.";
  std::size_t joint = joints;
  if (column.starts_with(kHead)) std::from_chars(column.data() + kHead.size(), column.data() + column.size(), joint);
  return std::min(joint, joints);
}

}  // namespace

std::vector<double> natural_scales(const Scenario& scenario, const ColumnList& columns) {
  constexpr double kGravity = 9.81;  // m/s^2
  const double g = scenario.physics.gravity.norm();
  const double weight = scenario.robot->mass * (g > 0 ? g : kGravity);
  const double length = extent(*scenario.robot, start_state(scenario));
  const std::vector<Motor> motors = motors_of(scenario);
  const Motor strongest{largest(motors, &Motor::torque), largest(motors, &Motor::current), largest(motors, &Motor::voltage)};
  const auto of = [&](const Column& column) -> double {
    const std::size_t joint = joint_of(column.name, motors.size());
    const Motor& motor = joint < motors.size() && motors[joint].torque > 0 ? motors[joint] : strongest;
    if (column.unit.empty() || column.unit == "rad") return 1;
    if (column.unit == "m") return length;
    if (column.unit == "N") return weight;
    if (column.unit == "N m") return motor.torque > 0 ? motor.torque : weight * length;
    if (column.unit == "A") return motor.current;
    return column.unit == "V" ? motor.voltage : 0;
  };
  std::vector<double> scales;
  for (const Column& column : columns) scales.push_back(std::isfinite(of(column)) ? of(column) : 0);
  return scales;
}

}  // namespace gaitlab::golden
