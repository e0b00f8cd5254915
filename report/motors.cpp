#include "report/motors.h"

#include <algorithm>
#include <memory>

#include "core/laws/dc_motor.h"
#include "core/plugin/plugin_instance.h"
#include "core/plugin/robot_info.h"
#include "core/scenario/explainer.h"
#include "core/scenario/reader.h"
#include "core/scenario/sections.h"
#include "report/settings_numbers.h"

namespace gaitlab::report {

namespace {
const std::string kOfTheScenario = " of the scenario; the rest: ";

/// The settings that a module type's map alone gives.
PluginSelection alone(const Entry& entry, const Node& map, const std::vector<std::string>& joints) {
  PluginSelection made{&entry, default_settings(entry)};
  Problems reported_before;
  Reader reader(map, "actuator", reported_before, &joints);
  visit_settings(entry, made.settings.get(), reader);
  return made;
}
}  // namespace

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
  if (scenario.actuator.entry == nullptr) return "";
  for (const Node& document : *scenario.module_documents) {
    const Node* actuator = document.find("actuator");
    const Node* source = actuator == nullptr ? nullptr : actuator->find("source");
    if (source == nullptr) continue;
    const Node* type = actuator->find("type");
    if (type == nullptr || type->text != scenario.actuator.entry->name) return "the scenario";
    const SettingsNumbers presets(alone(*scenario.actuator.entry, *actuator, joint_names(*scenario.robot)));
    std::string given;
    const SettingsNumbers settings(scenario.actuator);
    for (const SettingsNumbers::Found& setting : settings.all()) {
      if (!(setting.value == presets.find(setting.key)->value)) given += (given.empty() ? "" : ", ") + setting.key;
    }
    return given.empty() ? source->text : given + kOfTheScenario + source->text;
  }
  return "";
}

std::string no_created_energy(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return "";
  const std::string key = "efficiency_model";
  Explainer settings;
  visit_settings(*scenario.actuator.entry, default_settings(*scenario.actuator.entry).get(), settings);
  return std::ranges::find(settings.keys(), key) != settings.keys().end() ? "actuator." + key + ": directional does not" : "";
}

bool chosen(const std::string& source) {
  const std::size_t rest = source.find(kOfTheScenario);
  return source.substr(rest == std::string::npos ? 0 : rest + kOfTheScenario.size()).starts_with("chosen");
}

}  // namespace gaitlab::report
