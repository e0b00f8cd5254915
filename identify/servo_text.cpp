#include "identify/servo_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

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

/// A section of the servo file, with the keys that are fitted and those that are not.
struct Section {
  Node map = {Node::Kind::map};
  std::vector<std::string> fitted, stated;
};

Section section_of(const Node& motors, const std::string& name, const Identified& made, const std::vector<Key>& keys) {
  Section section;
  const auto add = [&](const std::string& key, Node value) {
    section.map.keys.emplace_back(key, SourceLocation{});
    section.map.items.push_back(std::move(value));
  };
  std::vector<std::pair<std::string, double>> fitted;
  for (const IdentifiedKey& one : made.keys) {
    const std::string& key = keys[one.key].name;
    if (one.fitted && key.starts_with(name + ".")) fitted.emplace_back(key.substr(name.size() + 1), one.value);
  }
  if (const Node* const stated = motors.find(name)) {
    for (std::size_t i = 0; i < stated->keys.size(); ++i) {
      const std::string& key = stated->keys[i].first;
      if (key == "source") continue;
      if (std::ranges::any_of(fitted, [&](const auto& one) { return one.first == key; })) continue;
      add(key, stated->items[i]);
      if (key != "type") section.stated.push_back(key);
    }
  }
  for (const auto& [key, value] : fitted) {
    add(key, scalar_node(number_text(value)));
    section.fitted.push_back(key);
  }
  return section;
}

}  // namespace

std::string error_text(double error, Logged kind) {
  constexpr double kMilli = 1e-3;
  if (kind == Logged::angle) return fmt::format("{:.3g} mrad", error / kMilli);
  return fmt::format("{:.3g} {}", error, logged_kinds()[static_cast<std::size_t>(kind)].unit);
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
                  error_text(mean_error(logs, made.after, made.kind, false).value_or(0), made.kind), fastest);
  if (const auto held_out = mean_error(logs, made.after, made.kind, true))
    text += fmt::format("; held-out error {} on {}", error_text(*held_out, made.kind), counted(logs.size() - fitted, "log"));
  return text;
}

std::string servo_text(const std::string& name, const std::string& file, const std::vector<std::string>& sets,
                       const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys) {
  Node motors = motors_of(file, sets);
  const Node* const actuator_map = motors.find("actuator");
  const Node* const source = actuator_map == nullptr ? nullptr : actuator_map->find("source");
  const std::string of_stated = source == nullptr ? "stated in the bench" : source->text;
  std::vector<std::string> freed;
  if (!logs[0].freed.empty()) {
    // A stall current that bounds the product of torque and speed: no log has a current, and its efficiency is kept.
    Node& actuator = const_cast<Node&>(*actuator_map);
    remove(actuator, "stall_current");
    Problems none;
    apply_sets(motors, {logs[0].freed.back()}, none);
    freed = {"efficiency"};
  }
  Section actuator = section_of(motors, "actuator", made, keys);
  Section controller = section_of(motors, "controller", made, keys);
  for (Section* const section : {&actuator, &controller}) section->map.flow = false;
  std::vector<std::string> fitted = actuator.fitted;
  fitted.insert(fitted.end(), controller.fitted.begin(), controller.fitted.end());
  std::vector<std::string> stated = actuator.stated;
  stated.insert(stated.end(), controller.stated.begin(), controller.stated.end());
  std::erase_if(stated, [&](const std::string& key) { return std::ranges::find(freed, key) != freed.end(); });
  std::string text = fmt::format(
      "# Servo whose numbers follow from logs: gaitlab identify.\ngaitlab_servo: 1\nname: {}\nsources:\n", yaml_text(name));
  const auto add = [&](const std::vector<std::string>& of, const char* kind, const std::string& why) {
    if (!of.empty()) text += fmt::format("  - {{of: [{}], kind: {}, text: {}}}\n", fmt::join(of, ", "), kind, yaml_text(why));
  };
  add(fitted, "identified", source_text(made, logs));
  add(freed, "chosen", "that of the bench, because no log has a current");
  add(stated, source == nullptr ? "chosen" : "data sheet", of_stated);
  text += "actuator:\n" + print_yaml(actuator.map, 2);
  if (controller.map.items.size() > 1) text += "controller:\n" + print_yaml(controller.map, 2);
  return text;
}

}  // namespace gaitlab::identify
