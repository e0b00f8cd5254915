#include "report/analysis/motors.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "core/laws/dc_motor.h"
#include "core/plugin/robot_info.h"
#include "core/robot_files/servo_file.h"
#include "core/robot_files/type_presets.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/sections.h"
#include "core/settings/explainer.h"
#include "core/settings/settings_numbers.h"

namespace gaitlab::report {

bool dc_motors(const Scenario& scenario) { return !rest_torques(scenario).empty(); }

std::size_t driven_joints(const Robot& robot) {
  return static_cast<std::size_t>(std::ranges::count_if(robot.joints, [](const Joint& joint) { return joint.driven(); }));
}

std::vector<double> rest_torques(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return {};
  const std::unique_ptr<Actuator> actuator = make_motors(scenario);
  const DcMotor* const motors = actuator->dc_motors();
  std::vector<double> torques;
  for (std::size_t j = 0; motors != nullptr && j < scenario.robot->joints.size(); ++j)
    torques.push_back(scenario.robot->joints[j].driven() ? motors[j](motors[j].u_max, 0.0).torque : 0);
  return torques;
}

namespace {

/// Joins several sources into one text, chosen ones first. An empty source stands for values without a source.
std::string together(std::vector<std::string> sources) {
  for (std::string& one : sources) {
    if (one.empty()) one = kNoSource;
  }
  std::stable_partition(sources.begin(), sources.end(), chosen);
  return fmt::format("{}", fmt::join(sources, "; "));
}

/// Keys of the scenario's actuator values that differ from those of its module types.
std::vector<std::string> changed_figures(const Scenario& scenario, const TypePresets& types) {
  const Entry& entry = *scenario.actuator.entry;
  const PluginSelection preset{&entry, default_settings(entry)};
  Problems none;
  const std::vector<std::string> names = joint_names(*scenario.robot);
  types.fill(entry, preset.settings.get(), &names, none);
  const SettingsNumbers presets(preset);
  std::vector<std::string> keys;
  const SettingsNumbers settings(scenario.actuator);
  for (const SettingsNumbers::Found& setting : settings.all()) {
    const SettingsNumbers::Found* of_type = presets.find(setting.key);
    if (of_type != nullptr && setting.stated && !(setting.value == of_type->value)) keys.push_back(setting.key);
  }
  return keys;
}

/// Short form of a source: its first clause, or the statement that the values were chosen.
std::string in_few_words(const std::string& source) {
  constexpr std::size_t kLongest = 60;
  if (source.empty() || source.starts_with(kNoSource)) {
    const std::string reason = source.empty() ? kNoSource : source.substr(0, source.find("; "));
    return fmt::format("chosen figures ({})", reason.substr(reason.find(": ") + 2));
  }
  if (chosen(source)) return "chosen figures";
  std::string clause = one_line(source.substr(0, source.find("; ")));
  if (clause.size() <= kLongest) return clause;
  const std::size_t blank = clause.rfind(' ', kLongest);
  return blank == std::string::npos ? clause : clause.substr(0, clause.find_last_not_of(" ,:", blank) + 1) + " ...";
}

/// Short forms of several sources. If some of them are chosen, only those are included.
std::string in_few_words(const std::vector<std::string>& sources) {
  std::vector<std::string> words;
  const bool any_chosen = std::ranges::any_of(sources, chosen);
  for (const std::string& source : sources) {
    std::string few = in_few_words(source);
    if (chosen(source) == any_chosen && std::ranges::find(words, few) == words.end()) words.push_back(std::move(few));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::string motor_source(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return "";
  const TypePresets types(Kind::actuator, scenario.robot.get(), *scenario.module_documents);
  if (!types.holds(*scenario.actuator.entry)) return together({scenario.actuator_source});
  const std::vector<std::string> changed = changed_figures(scenario, types);
  std::string stated = together(types.sources(*scenario.actuator.entry, changed));
  if (changed.empty()) return stated;
  const std::string keys = fmt::format("{} of the scenario", fmt::join(changed, ", "));
  const std::string& own = scenario.actuator_source;
  std::string given = own.empty() ? fmt::format("{} for {}", kNoSource, keys) : fmt::format("{}: {}", keys, own);
  if (stated.empty()) return given;  // the scenario gives all values
  return !chosen(given) && chosen(stated) ? stated + "; " + given : fmt::format("{}; the rest: {}", given, stated);
}

std::vector<Identification> identifications(const Scenario& scenario) {
  std::vector<Identification> all(scenario.robot->joints.size());
  if (scenario.actuator.entry == nullptr) return all;
  const TypePresets types(Kind::actuator, scenario.robot.get(), *scenario.module_documents);
  const bool presets = !scenario.identified.any() && types.holds(*scenario.actuator.entry);
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (scenario.robot->joints[j].driven()) all[j] = presets ? types.identification(j) : scenario.identified;
  }
  if (presets && std::ranges::any_of(all, &Identification::any)) {
    const auto moves = [&](const std::string& key) {
      const auto states = [&](const Node& document) {
        return std::ranges::any_of(preset_maps(document, Kind::actuator),
                                   [&](const Node* map) { return map->find(key) != nullptr; });
      };
      return moves_joint(key, std::ranges::any_of(*scenario.module_documents, states));
    };
    if (std::ranges::any_of(changed_figures(scenario, types), moves)) all.assign(all.size(), {});
  }
  return all;
}

std::string silent_defaults(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr || scenario.robot->joints.empty()) return "";
  const SettingsNumbers settings(scenario.actuator);
  const auto stated = [&](const char* key) {
    const SourceLocation own = scenario.place(std::string("actuator.") + key);
    if (own.line > 0 || own.file != scenario.file) return true;
    return std::ranges::any_of(*scenario.module_documents, [&](const Node& document) {
      const std::vector<const Node*> maps = preset_maps(document, Kind::actuator);
      return std::ranges::any_of(maps, [&](const Node* map) { return map->find(key) != nullptr; });
    });
  };
  std::vector<std::string> silent;
  if (settings.find("stall_current") != nullptr && !stated("stall_current") && !stated("efficiency"))
    silent.emplace_back("efficiency 0.7");
  const bool usual = settings.find("load_friction") != nullptr;  // a servo's inertia then counts as chosen
  if (!usual && settings.find("rotor_inertia") != nullptr && !stated("rotor_inertia"))
    silent.emplace_back("rotor_inertia 0 (0.002 kg m^2 for a servo of 1 N m)");
  return silent.empty() ? "" : fmt::format("by default: {}", fmt::join(silent, ", "));
}

std::string no_created_energy(const Scenario& scenario) {
  if (scenario.actuator.entry == nullptr) return "";
  const std::string key = "efficiency_model";
  Explainer settings;
  visit_settings(*scenario.actuator.entry, default_settings(*scenario.actuator.entry).get(), settings);
  return std::ranges::find(settings.keys(), key) != settings.keys().end() ? "take actuator." + key + ": directional" : "";
}

bool chosen(const std::string& source) {
  constexpr std::string_view kWord = "chosen";
  const auto alike = [](char in_text, char in_word) { return in_text == in_word || in_text == in_word - 'a' + 'A'; };
  return source.empty() || std::search(source.begin(), source.end(), kWord.begin(), kWord.end(), alike) != source.end();
}

std::string figures_sentence(const std::vector<std::string>& motors, const std::vector<std::string>& docks,
                             const std::vector<std::string>& identified, bool all) {
  std::string of_docks = docks.empty() ? "" : "docks: " + in_few_words(docks);
  if (motors.empty()) return of_docks;
  std::string of_motors = fmt::format("{}", fmt::join(identified, ", "));
  if (identified.empty()) {
    of_motors = in_few_words(motors);
  } else if (!all || std::ranges::any_of(motors, chosen)) {
    of_motors += "; the rest: " + in_few_words(motors);
  }
  return "motors: " + of_motors + (docks.empty() ? "" : "; " + of_docks);
}

}  // namespace gaitlab::report
