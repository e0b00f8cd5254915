#include "identify/servo_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/files/hash.h"
#include "core/robot_files/servo_file.h"
#include "core/settings/overlay.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab::identify {

namespace {

constexpr const char* kOfTheRobot[] = {"u_max", "period"};  // supply, and clock of the controller

void remove(Node& map, const std::string& key) {
  const auto at = std::ranges::find(map.keys, key, [](const auto& one) { return one.first; }) - map.keys.begin();
  if (static_cast<std::size_t>(at) == map.keys.size()) return;
  map.keys.erase(map.keys.begin() + at);
  map.items.erase(map.items.begin() + at);
}

void put(Node& map, const std::string& key, double value) {
  map.keys.emplace_back(key, SourceLocation{});
  map.items.push_back(scalar_node(number_text(value)));
}

/// Actuator and controller of the bench, with the keys of the servo file that they name, without keys of the robot.
Node motors_of(const std::string& file, const std::vector<std::string>& sets) {
  const Node bench = read_yaml(file);
  Node motors{Node::Kind::map};
  for (const char* name : {"actuator", "controller"}) {
    const Node* const section = bench.find(name);
    if (section == nullptr) continue;
    motors.keys.emplace_back(name, section->place);
    motors.items.push_back(*section);
    for (const char* key : kOfTheRobot) remove(motors.items.back(), key);
  }
  Problems problems;
  std::vector<Problem> notes;
  std::vector<std::string> of_motors;
  for (const std::string& set : sets) {
    if (set.starts_with("actuator.") || set.starts_with("controller.")) of_motors.push_back(set);
  }
  apply_sets(motors, of_motors, problems);
  insert_servos(motors, std::filesystem::path(file).parent_path().string(), problems, notes);
  problems.raise();
  return motors;
}

/// The keys of a section of the servo file by their source: fitted, of the data sheet, and values of the bench.
struct Keys {
  std::vector<std::string> fitted, stated, kept;
};

/// Puts the values into the map of a section, and sorts its keys.
void take_values(Node& map, const std::string& section, const Identified& made, const std::vector<Key>& keys, Keys& sources) {
  for (const auto& key : map.keys) {
    if (key.first != "type" && key.first != "source") sources.stated.push_back(key.first);
  }
  for (const IdentifiedKey& one : made.keys) {
    const std::string& name = keys[one.key].name;
    if (!name.starts_with(section + ".")) continue;
    const std::string key = name.substr(section.size() + 1);
    const bool stated = map.find(key) != nullptr;
    if (!one.fitted && stated) continue;
    if (stated) {
      remove(map, key);
      std::erase(sources.stated, key);
    }
    put(map, key, one.value);
    (one.fitted ? sources.fitted : sources.kept).push_back(key);
  }
}

}  // namespace

std::string error_text(double error, Logged kind) {
  constexpr double kMilli = 1e-3;
  if (kind == Logged::angle) return fmt::format("{:.3g} mrad", error / kMilli);
  const std::string unit = logged_kinds()[static_cast<std::size_t>(kind)].unit;
  return fmt::format("{:.3g}{}{}", error, unit.empty() ? "" : " ", unit);
}

std::vector<std::string> origins_of(const std::vector<BenchLog>& logs) {
  std::vector<std::string> origins;
  for (const BenchLog& log : logs) {
    const std::string& origin = log.scenario.measured.source;
    if (!origin.empty() && std::ranges::find(origins, origin) == origins.end()) origins.push_back(origin);
  }
  return origins;
}

std::string source_text(const Identified& made, const std::vector<BenchLog>& logs) {
  std::string hashes;
  double fastest = 0;
  std::size_t fitted = 0;
  for (std::size_t l = 0; l < logs.size(); ++l) {
    if (logs[l].held_out) continue;
    ++fitted;
    hashes += logs[l].hash;
    fastest = std::max(fastest, made.after[l].largest_speed);
  }
  std::string text =
      fmt::format("identified from {} (hash {}), fitted to {}, speeds up to {:.3g} rad/s", counted(fitted, "log"), hash(hashes),
                  error_text(mean_error(logs, made.after, made.kinds[0], false).value_or(0), made.kinds[0]), fastest);
  if (const auto held_out = mean_error(logs, made.after, made.kinds[0], true))
    text +=
        fmt::format("; held-out error {} on {}", error_text(*held_out, made.kinds[0]), counted(logs.size() - fitted, "log"));
  for (const std::string& origin : origins_of(logs)) text += "; " + origin;
  return text;
}

bool holds_in_servo_file(const Key& key) {
  const std::size_t dot = key.name.find('.');
  const std::string section = key.name.substr(0, dot);
  return (section == "actuator" || section == "controller") && key.name.find('.', dot + 1) == std::string::npos;
}

std::string servo_text(const std::string& name, const std::string& file, const std::vector<std::string>& sets,
                       const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys) {
  Node motors = motors_of(file, sets);
  std::string text = fmt::format(
      "# Servo whose numbers follow from logs: gaitlab identify.\ngaitlab_servo: 1\nname: {}\nsources:\n", yaml_text(name));
  std::string maps;
  std::optional<std::string> of_stated;
  Keys sources;
  for (std::size_t i = 0; i < motors.items.size(); ++i) {
    const std::string& section = motors.keys[i].first;
    Node& map = motors.items[i];
    const Node* const type = map.find("type");
    if (section == "controller" && (type == nullptr || type->text != "rc_servo")) continue;  // not the servo's own
    if (const Node* const source = map.find("source")) of_stated = source->text;
    remove(map, "source");
    take_values(map, section, made, keys, sources);
    if (section == "actuator" && logs[0].efficiency) {
      remove(map, "stall_current");
      std::erase(sources.stated, "stall_current");
      put(map, "efficiency", *logs[0].efficiency);
      sources.kept.emplace_back("efficiency");
    }
    map.flow = false;
    maps += section + ":\n" + print_yaml(map, 2);
  }
  const auto add = [&](const std::vector<std::string>& of, const char* kind, const std::string& why) {
    if (!of.empty()) text += fmt::format("  - {{of: [{}], kind: {}, text: {}}}\n", fmt::join(of, ", "), kind, yaml_text(why));
  };
  add(sources.fitted, "identified", source_text(made, logs));
  add(sources.kept, "chosen", "value of the bench; it does not follow from these logs");
  add(sources.stated, of_stated ? "data sheet" : "chosen", of_stated.value_or("stated in the bench"));
  return text + maps;
}

}  // namespace gaitlab::identify
