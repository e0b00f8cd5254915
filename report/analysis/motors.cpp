#include "report/analysis/motors.h"

#include <algorithm>
#include <memory>

#include "core/laws/dc_motor.h"
#include "core/plugin/plugin_instance.h"
#include "core/plugin/robot_info.h"
#include "core/robot_files/type_presets.h"
#include "core/scenario/sections.h"
#include "core/settings/explainer.h"
#include "report/analysis/settings_numbers.h"

namespace gaitlab::report {

namespace {
const std::string kOfTheScenario = " of the scenario; the rest: ";
}  // namespace

bool dc_motors(const Scenario& scenario) { return !rest_torques(scenario).empty(); }

std::size_t driven_joints(const Robot& robot) {
  return static_cast<std::size_t>(std::ranges::count_if(robot.joints, [](const Joint& joint) { return joint.driven(); }));
}

std::vector<double> rest_torques(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return {};
  const std::unique_ptr<Actuator> actuator = make_actuator(scenario.actuator, info(*scenario.robot));
  const DcMotor* const motors = actuator->dc_motors();
  std::vector<double> torques;
  for (std::size_t j = 0; motors != nullptr && j < scenario.robot->joints.size(); ++j)
    torques.push_back(scenario.robot->joints[j].driven() ? motors[j](motors[j].u_max, 0.0).torque : 0);
  return torques;
}

namespace {

/// What the types that have a motor say of it, each source once; those that are chosen first.
std::string stated_sources(const Scenario& scenario) {
  std::vector<std::string> sources;
  for (const Node& document : *scenario.module_documents) {
    for (const Node* map : preset_maps(document, Kind::actuator)) {
      const Node* source = map->find("source");
      if (source != nullptr && std::ranges::find(sources, source->text) == sources.end()) sources.push_back(source->text);
    }
  }
  std::stable_partition(sources.begin(), sources.end(), [](const std::string& one) { return chosen(one); });
  std::string text;
  for (const std::string& one : sources) text += (text.empty() ? "" : "; ") + one;
  return text;
}

}  // namespace

std::string motor_source(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return "";
  const std::string stated = stated_sources(scenario);
  if (stated.empty()) return "";
  const Entry& entry = *scenario.actuator.entry;
  const TypePresets types(Kind::actuator, scenario.robot.get(), *scenario.module_documents);
  if (entry.name != types.type() || !types.agreed()) return "the scenario";
  const PluginSelection preset{&entry, default_settings(entry)};
  Problems none;
  const std::vector<std::string> names = joint_names(*scenario.robot);
  types.fill(entry, preset.settings.get(), &names, none);
  const SettingsNumbers presets(preset);
  std::string given;
  const SettingsNumbers settings(scenario.actuator);
  for (const SettingsNumbers::Found& setting : settings.all()) {
    const SettingsNumbers::Found* of_type = presets.find(setting.key);
    if (of_type != nullptr && !(setting.value == of_type->value)) given += (given.empty() ? "" : ", ") + setting.key;
  }
  return given.empty() ? stated : given + kOfTheScenario + stated;
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
  return source.find("chosen", rest == std::string::npos ? 0 : rest + kOfTheScenario.size()) != std::string::npos;
}

}  // namespace gaitlab::report
