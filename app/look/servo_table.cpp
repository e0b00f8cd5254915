#include "app/look/servo_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/look/cells.h"
#include "core/laws/dc_motor.h"
#include "core/plugin/plugin_instance.h"
#include "core/robot_files/servo_file.h"
#include "core/settings/reader.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"

namespace gaitlab::app {

namespace {

/// Plugin with the settings of a map, for a robot of one joint.
PluginSelection selected(Kind kind, const Node& map, const Catalog& catalog, Problems& problems) {
  const Node* const type = map.find("type");
  const std::string name = type == nullptr ? describe(kind).default_type : type->text;
  const Entry* const entry = catalog.find(kind, name);
  if (entry == nullptr) {
    problems.add(type == nullptr ? map.place : type->place,
                 "type " + in_quotes(name) + " is unknown" + offer(name, catalog.names(kind), "types"));
    return {};
  }
  PluginSelection made{entry, default_settings(*entry)};
  Reader reader(map, word(kind), problems, nullptr);
  reader.take("type");
  visit_settings(*entry, made.settings.get(), reader);
  reader.finish();
  return made;
}

class Table {
 public:
  explicit Table(const ServoFile& servo) : servo_(servo) {}

  /// Begins a part; its first row has its name.
  void begin(const char* part) { part_ = part; }
  /// Adds a number that is stated, or that follows from others by usual values.
  void add(const std::string& key, const std::string& value, bool stated) {
    const ServoSource* const source = servo_.source_of(key);
    const char* const kind = !stated ? "chosen" : source == nullptr ? "stated" : name_of(source->kind);
    row(key, value, kind, stated ? reference(source == nullptr ? servo_.source : source->text) : reference(kUsual));
  }
  void row(const std::string& key, const std::string& value, const std::string& kind, const std::string& source) {
    rows_.push_back({part_, key, value, kind, source});
    part_.clear();
  }
  [[nodiscard]] std::string text() const {
    std::string sources;
    for (std::size_t i = 0; i < sources_.size(); ++i)
      sources += "  " + wrapped(fmt::format("[{}] {}", i + 1, one_line(sources_[i])), 6, 98).substr(6);
    return cells_text(rows_) + "\nsources\n" + sources;
  }

 private:
  static constexpr const char* kUsual = "usual for a servo: gaitlab explain actuator servo";
  /// `[2]`
  std::string reference(const std::string& source) {
    const auto at = std::ranges::find(sources_, source);
    const auto number = at - sources_.begin() + 1;
    if (at == sources_.end()) sources_.push_back(source);
    return fmt::format("[{}]", number);
  }
  const ServoFile& servo_;
  std::string part_;
  std::vector<Cells> rows_;
  std::vector<std::string> sources_;
};

std::string number(double value, const std::string& unit) {
  return fmt::format("{:.5g}{}{}", value, unit.empty() ? "" : " ", unit);
}

/// Adds the numbers of a map with these keys. Ratings that are not stated are left out.
void add_numbers(const PluginSelection& plugin, const Node& map, std::initializer_list<const char*> keys, Table& table) {
  const SettingsNumbers numbers(plugin);
  for (const char* const key : keys) {
    const SettingsNumbers::Found* const found = numbers.find(key);
    const bool stated = map.find(key) != nullptr;
    if (found == nullptr || (!stated && found->stated)) continue;
    table.add(key, number(found->value[0], found->unit), stated);
  }
}

/// Adds every key of the firmware as the file states it, and the gain that follows.
void add_firmware(const PluginSelection& plugin, const Node& map, const RobotInfo& robot, Table& table) {
  const SettingsNumbers numbers(plugin);
  for (std::size_t i = 0; i < map.items.size(); ++i) {
    const std::string& key = map.keys[i].first;
    if (key == "type") continue;
    const SettingsNumbers::Found* const found = numbers.find(key);
    table.add(key, found == nullptr ? map.items[i].text : number(found->value[0], found->unit), true);
  }
  const std::vector<PositionGains> gains = make_controller(plugin, robot)->gains();
  if (gains.empty() || map.find("gain") != nullptr) return;
  const bool of_P = map.find(gains[0].key) != nullptr;
  table.row("gain", number(gains[0].P, "/rad"), of_P ? fmt::format("by {}", gains[0].key) : "chosen", "");
}

}  // namespace

std::string servo_table(const std::string& path, const std::string& about, const Catalog& catalog) {
  Problems problems;
  const std::optional<ServoFile> servo = read_servo(path, {path}, problems);
  PluginSelection actuator, controller;
  if (servo) actuator = selected(Kind::actuator, servo->actuator, catalog, problems);
  const bool firmware = servo && servo->controller.kind == Node::Kind::map;
  if (firmware) controller = selected(Kind::controller, servo->controller, catalog, problems);
  if (!problems.empty()) throw InputError(problems.list());
  RobotInfo robot;
  robot.joints.push_back({.name = "servo"});
  robot.control_period = 1;
  Table table(*servo);
  const Node& map = servo->actuator;
  table.begin("line");
  add_numbers(actuator, map, {"voltage", "stall_torque", "no_load_speed", "stall_current", "efficiency"}, table);
  const std::unique_ptr<Actuator> made = make_actuator(actuator, robot);
  if (const DcMotor* const motor = made->dc_motors();
      motor != nullptr && map.find("stall_current") == nullptr && map.find("efficiency") == nullptr)
    table.add("efficiency", number(motor->efficiency, ""), false);
  table.begin("friction");
  add_numbers(actuator, map, {"dry_friction", "viscous_friction", "load_friction"}, table);
  table.begin("rotor");
  add_numbers(actuator, map, {"rotor_inertia"}, table);
  table.begin("firmware");
  if (firmware) {
    add_firmware(controller, servo->controller, robot, table);
  } else {
    table.row("none", "", "", "");
  }
  const std::string logs = servo->identified.any() ? "\nlogs\n  " + wrapped(long_text(servo->identified), 2, 98).substr(2) : "";
  return fmt::format("{}: {}\n{}{}", servo->name, wrapped(about), table.text(), logs);
}

std::string servo_row(const std::string& path, const std::string& head) {
  constexpr const char* kExpected = "data sheet with usual losses; the errors of three such servos are 43, 65 and 81 mrad";
  Problems problems;
  const std::optional<ServoFile> servo = read_servo(path, {path}, problems);
  if (!servo) throw InputError(problems.list());
  const ServoSource* const line = servo->source_of("stall_torque");
  std::string origin = kExpected;
  if (servo->identified.any()) {
    origin = long_text(servo->identified);
  } else if (line != nullptr && line->kind == ServoFigure::identified) {
    origin = "identified, error not stated: " + line->text.substr(0, line->text.find(':'));
  }
  return fmt::format("{}: {}", head, origin);
}

}  // namespace gaitlab::app
