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

constexpr const char* kOfBench = "value of the bench; it does not follow from these logs";
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

/// Actuator or controller of the bench.
struct Section {
  std::string name;
  Node map;                        ///< with the keys of the servo file that it names, without keys of the robot
  std::optional<ServoFile> servo;  ///< the file
  std::vector<std::string> own;    ///< keys that the bench states itself
  std::string source;              ///< that of these keys; "" for none
};

std::vector<Section> sections_of(const std::string& file, const std::vector<std::string>& sets) {
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
  const std::string folder = std::filesystem::path(file).parent_path().string();
  std::vector<Section> sections;
  for (std::size_t i = 0; i < motors.items.size(); ++i) {
    const Node& map = motors.items[i];
    Section& made = sections.emplace_back(Section{motors.keys[i].first, {}, named_servo(map, folder, problems), {}, {}});
    for (const auto& key : map.keys) made.own.push_back(key.first);
    if (const Node* const source = map.find("source")) made.source = source->text;
  }
  insert_servos(motors, folder, problems, notes);
  problems.raise();
  for (std::size_t i = 0; i < sections.size(); ++i) {
    sections[i].map = std::move(motors.items[i]);
    remove(sections[i].map, "source");
    remove(sections[i].map, kIdentified);
    sections[i].map.flow = false;
  }
  return sections;
}

/// The numbers of the servo file by their sources.
class Sources {
 public:
  void add(const std::string& key, ServoFigure kind, const std::string& text) {
    const auto same = [&](const ServoSource& one) { return one.kind == kind && one.text == text; };
    const auto at = std::ranges::find_if(all_, same);
    (at == all_.end() ? all_.emplace_back(ServoSource{{}, kind, text}) : *at).of.push_back(key);
  }
  /// Adds a key of the bench with its value in the bench.
  void add_stated(const std::string& key, const Section& section) {
    if (std::ranges::find(section.own, key) != section.own.end() || !section.servo) {
      const bool sourced = !section.source.empty();
      add(key, sourced ? ServoFigure::data_sheet : ServoFigure::chosen, sourced ? section.source : "stated in the bench");
    } else if (const ServoSource* const source = section.servo->source_of(key)) {
      add(key, source->kind, source->text);
    } else {
      add(key, section.servo->identified.any() ? ServoFigure::identified : ServoFigure::data_sheet, section.servo->source);
    }
  }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const ServoSource& one : all_) {
      text += fmt::format("  - {{of: [{}], kind: {}, text: {}}}\n", fmt::join(one.of, ", "), name_of(one.kind),
                          yaml_text(one.text));
    }
    return text;
  }

 private:
  std::vector<ServoSource> all_;
};

/// Puts the values into the map of a section.
void take_values(Section& section, const Identified& made, const std::vector<Key>& keys, const std::string& of_fitted,
                 Sources& sources) {
  std::vector<std::string> kept, taken;
  for (const IdentifiedKey& one : made.keys) {
    const std::string& name = keys[one.key].name;
    if (!name.starts_with(section.name + ".")) continue;
    const std::string key = name.substr(section.name.size() + 1);
    if (!one.fitted && section.map.find(key) != nullptr) continue;
    remove(section.map, key);
    put(section.map, key, one.value);
    taken.push_back(key);
    if (one.fitted) {
      sources.add(key, ServoFigure::identified, of_fitted);
    } else {
      kept.push_back(key);
    }
  }
  for (const std::string& key : kept) sources.add(key, ServoFigure::chosen, kOfBench);
  for (const auto& key : section.map.keys) {
    if (key.first != "type" && std::ranges::find(taken, key.first) == taken.end()) sources.add_stated(key.first, section);
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
  const Identification identified = identification(made, logs);
  Sources sources;
  std::string maps;
  for (Section& section : sections_of(file, sets)) {
    const Node* const type = section.map.find("type");
    const bool firmware = section.name == "controller";
    if (firmware && (type == nullptr || type->text != "rc_servo")) continue;  // not the servo's own
    const std::optional<double> efficiency = firmware ? std::nullopt : logs[0].efficiency;
    if (efficiency) remove(section.map, "stall_current");
    take_values(section, made, keys, long_text(identified), sources);
    if (efficiency) {
      put(section.map, "efficiency", *efficiency);
      sources.add("efficiency", ServoFigure::chosen, kOfBench);
    }
    maps += section.name + ":\n" + print_yaml(section.map, 2);
  }
  return fmt::format("# Servo whose numbers follow from logs: gaitlab identify.\ngaitlab_servo: 1\nname: {}\nsources:\n{}{}{}",
                     yaml_text(name), sources.text(), identified_text(identified), maps);
}

}  // namespace gaitlab::identify
