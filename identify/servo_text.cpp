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

constexpr const char* kOfTheRobot[] = {"model", "source", "u_max", "period"};

/// A section of the servo file, with the keys that are fitted and those that are not.
struct Section {
  Node map = {Node::Kind::map};
  std::vector<std::string> fitted, stated;
};

Section section_of(const Node& bench, const std::string& name, const Identified& made, const std::vector<Key>& keys) {
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
  if (const Node* const stated = bench.find(name)) {
    for (std::size_t i = 0; i < stated->keys.size(); ++i) {
      const std::string& key = stated->keys[i].first;
      const bool replaced = std::ranges::any_of(fitted, [&](const auto& one) { return one.first == key; });
      const bool of_robot = std::ranges::find(kOfTheRobot, key) != std::end(kOfTheRobot);
      const bool zero = key == "stall_current" && stated->items[i].text == "0";
      if (replaced || of_robot || zero) continue;
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
  Node bench = read_yaml(file);
  Problems problems;
  std::vector<Problem> notes;
  apply_sets(bench, sets, problems);
  apply_sets(bench, logs[0].freed, problems);
  insert_servos(bench, std::filesystem::path(file).parent_path().string(), problems, notes);
  problems.raise();
  Section actuator = section_of(bench, "actuator", made, keys);
  Section controller = section_of(bench, "controller", made, keys);
  for (Section* const section : {&actuator, &controller}) section->map.flow = false;
  std::vector<std::string> fitted = actuator.fitted;
  fitted.insert(fitted.end(), controller.fitted.begin(), controller.fitted.end());
  std::vector<std::string> stated = actuator.stated;
  stated.insert(stated.end(), controller.stated.begin(), controller.stated.end());
  std::string text = fmt::format("gaitlab_servo: 1\nname: {}\nsources:\n", yaml_text(name));
  text += fmt::format("  - {{of: [{}], kind: identified, text: {}}}\n", fmt::join(fitted, ", "),
                      yaml_text(source_text(made, logs)));
  if (!stated.empty())
    text += fmt::format(
        "  - {{of: [{}], kind: chosen, text: {}}}\n", fmt::join(stated, ", "),
        yaml_text(logs[0].scenario.actuator_source.empty() ? "stated in the bench" : logs[0].scenario.actuator_source));
  text += "actuator:\n" + print_yaml(actuator.map, 2);
  if (controller.map.items.size() > 1) text += "controller:\n" + print_yaml(controller.map, 2);
  return text;
}

}  // namespace gaitlab::identify
