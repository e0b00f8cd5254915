#include "report/motors.h"

#include <memory>

#include "core/laws/dc_motor.h"
#include "core/plugin/plugin_instance.h"
#include "core/plugin/robot_info.h"
#include "core/scenario/value.h"
#include "report/settings_numbers.h"

namespace gaitlab::report {

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
