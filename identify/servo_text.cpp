#include "identify/servo_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/files/hash.h"
#include "core/robot_files/identification.h"
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

/// The quantities of both lists have the same order.
Identification::Quantity quantity_of(Logged kind) {
  static_assert(static_cast<std::size_t>(Identification::Quantity::duty) == static_cast<std::size_t>(Logged::duty) &&
                static_cast<std::size_t>(Logged::duty) + 1 == kLoggedKinds);
  return static_cast<Identification::Quantity>(kind);
}

/// Largest speed of a joint in a log, rad/s: that of its speeds, or of its angles over intervals of at least kSpan.
double largest_speed(const MeasuredLog& log) {
  constexpr double kSpan = 0.025;  // s; chosen: a tick of 12 bits is then 0.06 rad/s
  double most = 0;
  for (const MeasuredLog::OfJoint& joint : log.joints) {
    for (const double speed : joint.of(Logged::speed)) most = std::max(most, std::abs(speed));
    const std::vector<double>& angle = joint.of(Logged::angle);
    if (!joint.of(Logged::speed).empty()) continue;
    for (std::size_t k = 0, from = 0; k < angle.size(); ++k) {
      while (log.t[k] - log.t[from + 1] >= kSpan) ++from;
      if (log.t[k] - log.t[from] >= kSpan) most = std::max(most, std::abs(angle[k] - angle[from]) / (log.t[k] - log.t[from]));
    }
  }
  return most;
}

/// The value with the digits that it has in texts.
double in_short(double value) { return std::stod(fmt::format("{:.3g}", value)); }

/// The same, but not less than the value: a run of the logs themselves stays within them.
double not_less(double value) {
  constexpr double kHalfDigit = 0.005;  // half of the last of three digits is at most this share of the value
  const double near = in_short(value);
  return near < value ? in_short(value * (1 + kHalfDigit)) : near;
}

/// YAML of an identification.
std::string identified_text(Identification identified) {
  const std::vector<std::string> no_names;
  Writer writer(no_names);
  identified.fields(writer);
  Node map = writer.take();
  map.flow = false;
  if (identified.by.empty()) remove(map, "by");
  return fmt::format("{}:\n{}", kIdentified, print_yaml(map, 2));
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

std::string error_text(double error, Logged kind) { return gaitlab::error_text(error, quantity_of(kind)); }

std::vector<std::string> origins_of(const std::vector<BenchLog>& logs) {
  std::vector<std::string> origins;
  for (const BenchLog& log : logs) {
    const std::string& origin = log.scenario.measured.source;
    if (!origin.empty() && std::ranges::find(origins, origin) == origins.end()) origins.push_back(origin);
  }
  return origins;
}

Identification identification(const Identified& made, const std::vector<BenchLog>& logs) {
  Identification of;
  std::string hashes;
  for (std::size_t l = 0; l < logs.size(); ++l) {
    if (logs[l].held_out) {
      ++of.held_out_logs;
      continue;
    }
    ++of.logs;
    hashes += logs[l].hash;
    of.speed = std::max(of.speed, largest_speed(*logs[l].scenario.measured.log));
    of.torque = std::max(of.torque, made.after[l].largest_torque);
  }
  of.quantity = quantity_of(made.kinds[0]);
  of.error = in_short(mean_error(logs, made.after, made.kinds[0], false).value_or(0));
  of.held_out = in_short(mean_error(logs, made.after, made.kinds[0], true).value_or(0));
  of.held_out_before = in_short(mean_error(logs, made.before, made.kinds[0], true).value_or(0));
  of.speed = not_less(of.speed);
  of.torque = not_less(of.torque);
  of.by = fmt::format("{}", fmt::join(origins_of(logs), "; "));
  of.hash = hash(hashes);
  return of;
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
    remove(map, kIdentified);
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
  const Identification identified = identification(made, logs);
  add(sources.fitted, "identified", long_text(identified));
  add(sources.kept, "chosen", "value of the bench; it does not follow from these logs");
  add(sources.stated, of_stated ? "data sheet" : "chosen", of_stated.value_or("stated in the bench"));
  return text + identified_text(identified) + maps;
}

}  // namespace gaitlab::identify
