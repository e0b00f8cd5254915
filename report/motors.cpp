#include "report/motors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/laws/dc_motor.h"
#include "core/plugin/plugin_instance.h"
#include "core/plugin/robot_info.h"
#include "core/scenario/value.h"
#include "report/settings_numbers.h"

namespace gaitlab::report {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kFastest = 1e6;  // rad/s: a drive that still has torque there has no no-load speed

/// The torques of the largest commands at these speeds.
std::vector<double> largest(const Actuator& actuator, const std::vector<double>& speeds) {
  std::vector<double> command(speeds.size());
  std::vector<double> torque(speeds.size());
  std::vector<double> slope(speeds.size());
  const In limit = actuator.command_limit();
  for (std::size_t j = 0; j < command.size(); ++j) command[j] = std::isfinite(limit[j]) ? limit[j] : 0;
  actuator.effort(command, speeds, torque, slope);
  for (std::size_t j = 0; j < command.size(); ++j) torque[j] = std::isfinite(limit[j]) ? torque[j] : kInfinite;
  return torque;
}

/// Where the torque of the largest command, which falls with the speed, comes to 0: by halving, for all joints at once.
std::vector<double> no_load_speeds(const Actuator& actuator, std::size_t joints) {
  std::vector<double> low(joints, 0.0);
  std::vector<double> high(joints, kFastest);
  const std::vector<double> fastest = largest(actuator, high);
  constexpr int kHalvings = 80;  // 1e6 rad/s to its last digit
  for (int i = 0; i < kHalvings; ++i) {
    std::vector<double> middle(joints);
    for (std::size_t j = 0; j < joints; ++j) middle[j] = 0.5 * (low[j] + high[j]);
    const std::vector<double> torque = largest(actuator, middle);
    for (std::size_t j = 0; j < joints; ++j) (torque[j] > 0 ? low : high)[j] = middle[j];
  }
  for (std::size_t j = 0; j < joints; ++j) high[j] = fastest[j] > 0 ? kInfinite : high[j];
  return high;
}

}  // namespace

std::vector<Drive> drives(const Scenario& scenario) {
  const std::size_t joints = scenario.robot->joints.size();
  if (scenario.actuator.entry == nullptr || joints == 0) return {};
  const std::unique_ptr<Actuator> actuator = make_actuator(scenario.actuator, info(*scenario.robot));
  const std::vector<double> rest = largest(*actuator, std::vector<double>(joints, 0.0));
  const std::vector<double> no_load = no_load_speeds(*actuator, joints);
  const std::span<const DriveRatings> ratings = actuator->ratings();
  std::vector<Drive> made;
  for (std::size_t j = 0; j < joints; ++j) made.push_back({rest[j], no_load[j], ratings.empty() ? DriveRatings() : ratings[j]});
  return made;
}

bool dc_motors(const Scenario& scenario) { return !rest_torques(scenario).empty(); }

std::vector<double> rest_torques(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return {};
  const std::unique_ptr<Actuator> actuator = make_actuator(scenario.actuator, info(*scenario.robot));
  const DcMotor* const motors = actuator->dc_motors();
  std::vector<double> torques;
  for (std::size_t j = 0; motors != nullptr && j < scenario.robot->joints.size(); ++j)
    torques.push_back(motors[j](motors[j].u_max, 0.0).torque);
  return torques;
}

std::string motor_source(const Scenario& scenario) {
  const SettingsNumbers settings(scenario.actuator);
  for (const Node& document : *scenario.module_documents) {
    const Node* actuator = document.find("actuator");
    const Node* source = actuator == nullptr ? nullptr : actuator->find("source");
    if (source == nullptr) continue;
    for (std::size_t i = 0; i < actuator->items.size(); ++i) {
      const auto* setting = settings.find(actuator->keys[i].first);
      if (setting == nullptr || actuator->items[i].kind != Node::Kind::scalar) continue;
      const Reading<double> stated = read_number(actuator->items[i], "");
      if (stated.ok() && !(setting->value == PerJoint{stated.value})) return "the scenario";
    }
    return source->text;
  }
  return "";
}

bool chosen(const std::string& source) { return source.starts_with("chosen"); }

}  // namespace gaitlab::report
